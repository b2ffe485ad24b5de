// A bounding volume hierarchy over float boxes. It only proposes candidates: every box test errs on the side of a visit, and
// exact predicates decide afterwards.
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth::geometry {

/// Half the size of the scene's Bounds, of which a tree holds millions; what is made of doubles is rounded outwards.
struct FloatBox {
    glm::vec3 low, high;
};

/// The points from + s · (to − from), 0 ≤ s ≤ `last`, each known to within `pad` per axis.
class PaddedSegment {
public:
    PaddedSegment(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& pad);

    /// First parameter at which the padded segment may enter `box`; above `last` if it cannot.
    [[nodiscard]] double entry(const FloatBox& box) const {
        const glm::dvec3 a = (glm::dvec3(box.low) - padded_[0]) * inverse_;
        const glm::dvec3 b = (glm::dvec3(box.high) - padded_[1]) * inverse_;
        const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
        const double enter = glm::max(glm::max(near.x, near.y), glm::max(near.z, 0.0));
        const double leave = glm::min(glm::min(far.x, far.y), glm::min(far.z, last));
        return enter <= leave ? enter : outside;
    }

    static constexpr double outside = 2; // parameters end at 1
    double last = 1;

private:
    glm::dvec3 padded_[2]; // from + pad, from − pad
    glm::dvec3 inverse_;   // of the direction
};

class Bvh {
public:
    Bvh() = default;
    explicit Bvh(const std::vector<FloatBox>& boxes);

    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] const FloatBox& bounds() const { return nodes_.front().box; }

    /// Calls `visit(primitive)` for every box that the segment may meet, roughly front to back, until it returns true.
    /// `visit` may shorten `segment.last`. True if stopped.
    template <typename Visit>
    bool visit(const PaddedSegment& segment, Visit&& visit) const {
        if (nodes_.empty() || segment.entry(nodes_.front().box) > segment.last) return false;
        std::pair<double, std::uint32_t> pending[maxDepth];
        int count = 0;
        pending[count++] = {0.0, 0};
        while (count > 0) {
            const auto [entry, index] = pending[--count];
            if (entry > segment.last) continue;
            const Node& node = nodes_[index];
            if (node.count > 0) {
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                    if (visit(order_[i])) return true;
                continue;
            }
            const double left = segment.entry(nodes_[node.first].box), right = segment.entry(nodes_[node.first + 1].box);
            const bool leftFirst = left <= right;
            const std::pair<double, std::uint32_t> near{leftFirst ? left : right, node.first + (leftFirst ? 0U : 1U)};
            const std::pair<double, std::uint32_t> far{leftFirst ? right : left, node.first + (leftFirst ? 1U : 0U)};
            if (far.first <= segment.last) pending[count++] = far;
            if (near.first <= segment.last) pending[count++] = near;
        }
        return false;
    }

    /// Calls `visit(primitive)` for every leaf whose box passes `meets(box)`, as do those of all nodes above it.
    template <typename Meets, typename Visit>
    void visitBoxes(const Meets& meets, Visit&& visit) const {
        if (nodes_.empty() || !meets(nodes_.front().box)) return;
        std::uint32_t pending[maxDepth];
        int count = 0;
        pending[count++] = 0;
        while (count > 0) {
            const Node& node = nodes_[pending[--count]];
            if (node.count > 0) {
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
                continue;
            }
            for (std::uint32_t child = node.first; child < node.first + 2; ++child)
                if (meets(nodes_[child].box)) pending[count++] = child;
        }
    }

private:
    struct Node {
        FloatBox box;
        std::uint32_t first; // first primitive of a leaf, else the first of two neighbouring children
        std::uint32_t count; // primitives; 0 for an inner node
    };
    class Builder;
    static constexpr int maxDepth = 128; // the builder halves by count below depth 64, so 64 + 32 levels suffice

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

} // namespace shadowbench::groundtruth::geometry
