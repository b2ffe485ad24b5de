// Construction by the binned surface-area heuristic (Wald 2007).
#include "groundtruth/cgal/geometry/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace shadowbench::groundtruth::geometry {
namespace {

constexpr int binCount = 16;
constexpr std::uint32_t leafSize = 4;
constexpr int balancedBelow = 64; // depth from which nodes are halved by count, to bound the depth of the tree

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr FloatBox emptyBox{glm::vec3(infinity), glm::vec3(-infinity)};

void add(FloatBox& box, const FloatBox& other) {
    box.low = glm::min(box.low, other.low);
    box.high = glm::max(box.high, other.high);
}

float halfArea(const FloatBox& box) {
    const glm::vec3 size = box.high - box.low;
    return size.x < 0 ? 0 : size.x * size.y + size.y * size.z + size.z * size.x;
}

} // namespace

PaddedSegment::PaddedSegment(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& pad)
    : padded_{from + pad, from - pad}, inverse_(0) {
    for (int axis = 0; axis < 3; ++axis) {
        // A component too small to divide by moves the segment by less than any pad.
        constexpr double tiny = 1e-290;
        const double step = to[axis] - from[axis];
        inverse_[axis] = 1 / (std::abs(step) < tiny ? tiny : step);
    }
}

class Bvh::Builder {
public:
    Builder(Bvh& tree, const std::vector<FloatBox>& boxes) : nodes_(tree.nodes_), order_(tree.order_), boxes_(boxes) {
        order_.resize(boxes.size());
        std::iota(order_.begin(), order_.end(), 0U);
        nodes_.reserve(boxes.size());
        nodes_.emplace_back();
        build(0, 0, static_cast<std::uint32_t>(boxes.size()), 0);
        nodes_.shrink_to_fit();
    }

private:
    [[nodiscard]] float centre(std::uint32_t primitive, int axis) const {
        return 0.5F * boxes_[primitive].low[axis] + 0.5F * boxes_[primitive].high[axis];
    }

    void build(std::uint32_t node, std::uint32_t first, std::uint32_t last, int depth) {
        FloatBox box = emptyBox, centres = emptyBox;
        for (std::uint32_t i = first; i < last; ++i) {
            const std::uint32_t primitive = order_[i];
            const glm::vec3 c(centre(primitive, 0), centre(primitive, 1), centre(primitive, 2));
            add(box, boxes_[primitive]);
            add(centres, {c, c});
        }
        nodes_[node] = {box, first, last - first};
        if (last - first <= leafSize) return;

        const std::uint32_t middle = depth < balancedBelow ? split(first, last, centres) : halve(first, last, centres);
        const auto children = static_cast<std::uint32_t>(nodes_.size());
        nodes_[node].first = children;
        nodes_[node].count = 0;
        nodes_.resize(nodes_.size() + 2);
        build(children, first, middle, depth + 1);
        build(children + 1, middle, last, depth + 1);
    }

    /// Cheapest of the bin borders on the widest axis; halves by count where binning cannot separate anything.
    std::uint32_t split(std::uint32_t first, std::uint32_t last, const FloatBox& centres) {
        const int axis = widest(centres);
        const float low = centres.low[axis], extent = centres.high[axis] - low;
        if (!(extent > 0)) return halve(first, last, centres);

        const auto binOf = [&](std::uint32_t primitive) {
            return std::min(binCount - 1, static_cast<int>((centre(primitive, axis) - low) / extent * binCount));
        };
        std::array<FloatBox, binCount> box;
        std::array<std::uint32_t, binCount> count{};
        box.fill(emptyBox);
        for (std::uint32_t i = first; i < last; ++i) {
            const int bin = binOf(order_[i]);
            add(box[bin], boxes_[order_[i]]);
            ++count[bin];
        }

        const int border = cheapestBorder(box, count);
        if (border == 0) return halve(first, last, centres);
        const auto middle = std::partition(order_.begin() + first, order_.begin() + last,
                                           [&](std::uint32_t primitive) { return binOf(primitive) < border; });
        return static_cast<std::uint32_t>(middle - order_.begin());
    }

    static int cheapestBorder(const std::array<FloatBox, binCount>& box, const std::array<std::uint32_t, binCount>& count) {
        std::array<float, binCount> right{}; // cost of everything from a bin on
        FloatBox sum = emptyBox;
        std::uint32_t total = 0;
        for (int bin = binCount - 1; bin > 0; --bin) {
            add(sum, box[bin]);
            total += count[bin];
            right[bin] = halfArea(sum) * static_cast<float>(total);
        }
        const std::uint32_t all = total + count[0];
        int best = 0;
        float lowest = infinity;
        sum = emptyBox;
        total = 0;
        for (int border = 1; border < binCount; ++border) {
            add(sum, box[border - 1]);
            total += count[border - 1];
            const float cost = halfArea(sum) * static_cast<float>(total) + right[border];
            if (total == 0 || total == all || cost >= lowest) continue;
            lowest = cost;
            best = border;
        }
        return best;
    }

    std::uint32_t halve(std::uint32_t first, std::uint32_t last, const FloatBox& centres) {
        const int axis = widest(centres);
        const std::uint32_t middle = first + (last - first) / 2;
        std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                         [&](std::uint32_t a, std::uint32_t b) { return centre(a, axis) < centre(b, axis); });
        return middle;
    }

    static int widest(const FloatBox& box) {
        const glm::vec3 size = box.high - box.low;
        if (size.x >= size.y && size.x >= size.z) return 0;
        return size.y >= size.z ? 1 : 2;
    }

    std::vector<Node>& nodes_;
    std::vector<std::uint32_t>& order_;
    const std::vector<FloatBox>& boxes_;
};

Bvh::Bvh(const std::vector<FloatBox>& boxes) {
    if (!boxes.empty()) Builder(*this, boxes);
}

} // namespace shadowbench::groundtruth::geometry
