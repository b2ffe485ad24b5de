// Scores of hard labels.
#include "base/error.h"
#include "harness/metrics/pixels.h"

namespace shadowbench::metrics {
namespace {

/// Wrong pixels of a class and all of that class.
struct Tally {
    std::size_t wrong = 0, all = 0;
    void add(bool isWrong) {
        ++all;
        if (isWrong) ++wrong;
    }
    [[nodiscard]] std::optional<double> share() const {
        if (all == 0) return {};
        return static_cast<double>(wrong) / static_cast<double>(all);
    }
};

struct HardTally {
    Tally all, offEdge, lit, shadowed;
};

HardTally tally(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    constexpr float edgePixel = 0.5F; // this near the exact edge, in pixels
    HardTally result;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (!mask.scored[i]) continue;
        const bool lit = isLit(truth.visibility[i]);
        const bool wrong = isLit(v[i]) != lit;
        result.all.add(wrong);
        (lit ? result.lit : result.shadowed).add(wrong);
        if (truth.edgeDistance[i] > edgePixel) result.offEdge.add(wrong);
    }
    return result;
}

} // namespace

Accuracy hardAccuracy(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    requireComparable(v, truth, mask);
    const HardTally counts = tally(v, truth, mask);
    Accuracy result;
    result.mismatch = counts.all.share();
    result.mismatchOffEdge = counts.offEdge.share();
    result.falseShadow = counts.lit.share();
    result.leak = counts.shadowed.share();
    result.edgeError = edgeError(v, truth, mask);
    result.primaryMismatch = mask.primaryMismatch;
    return result;
}

double mismatch(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    requireComparable(v, truth, mask);
    const std::optional<double> share = tally(v, truth, mask).all.share();
    if (!share) throw BadInput("scoring a frame in which no pixel shows a receiver; turn the camera or the light");
    return *share;
}

} // namespace shadowbench::metrics
