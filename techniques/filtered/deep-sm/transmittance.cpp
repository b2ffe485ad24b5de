#include "techniques/filtered/deep-sm/transmittance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shadowbench::techniques {

void gatherSteps(std::span<const float> hits, int samples, Transmittance& function) {
    function.clear();
    float passed = 1;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (i == 0 || hits[i] != hits[i - 1]) function.push_back({hits[i], passed});
        passed = 1 - static_cast<float>(i + 1) / static_cast<float>(samples);
        if (i + 1 == hits.size() || hits[i + 1] != hits[i]) function.push_back({hits[i], passed});
    }
}

namespace {

/// The segment that is being drawn out from `origin`, and the slopes open to it.
class Segment {
public:
    explicit Segment(TransmittanceNode origin) : origin_(origin) {}

    /// Whether the segment can also pass within `error` of `vertex`; narrows the slopes if so.
    bool take(const TransmittanceNode& vertex, float error) {
        const float length = vertex.depth - origin_.depth;
        const float low = std::max(vertex.transmittance - error, 0.0F), high = vertex.transmittance + error;
        if (length <= 0) return low <= origin_.transmittance && origin_.transmittance <= high;
        const float steepest = std::max(steepest_, (low - origin_.transmittance) / length);
        const float flattest = std::min(flattest_, (high - origin_.transmittance) / length);
        if (steepest > flattest) return false;
        steepest_ = steepest;
        flattest_ = flattest;
        return true;
    }

    /// Its end beside `vertex`, the last that it has taken, by the middle one of its slopes.
    [[nodiscard]] TransmittanceNode endAt(const TransmittanceNode& vertex) const {
        return along(vertex.depth, 0.5F * (steepest_ + flattest_));
    }

    /// The same by the slope that comes closest to `vertex`.
    [[nodiscard]] TransmittanceNode closestEndAt(const TransmittanceNode& vertex) const {
        const float length = vertex.depth - origin_.depth;
        if (length <= 0) return vertex;
        return along(vertex.depth,
                     std::clamp((vertex.transmittance - origin_.transmittance) / length, steepest_, flattest_));
    }

    [[nodiscard]] const TransmittanceNode& origin() const { return origin_; }

private:
    [[nodiscard]] TransmittanceNode along(float depth, float slope) const {
        const float length = depth - origin_.depth;
        if (length <= 0) return origin_;
        return {depth, std::max(origin_.transmittance + slope * length, 0.0F)}; // what rounding leaves below 0
    }

    TransmittanceNode origin_;
    float steepest_ = -std::numeric_limits<float>::infinity();
    float flattest_ = 0; // transmittance never grows
};

} // namespace

void compress(std::span<const TransmittanceNode> exact, float error, Transmittance& compressed) {
    if (exact.empty()) return;
    const auto append = [&](const TransmittanceNode& node) {
        const TransmittanceNode& last = compressed.back();
        if (node.depth > last.depth || node.transmittance < last.transmittance) compressed.push_back(node);
    };
    compressed.push_back(exact.front());
    Segment segment(exact.front());
    for (std::size_t i = 1; i < exact.size(); ++i) {
        if (segment.take(exact[i], error)) continue;
        const TransmittanceNode end = segment.endAt(exact[i - 1]);
        append(end);
        segment = Segment(end);
        if (segment.take(exact[i], error)) continue;
        append(exact[i]); // a jump
        segment = Segment(exact[i]);
    }
    append(segment.closestEndAt(exact.back()));
}

} // namespace shadowbench::techniques
