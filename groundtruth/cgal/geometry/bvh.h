// A bounding volume hierarchy over float boxes, four children to a node. It only proposes candidates: every box test errs on
// the side of a visit, and exact predicates decide afterwards.
#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench::groundtruth::geometry {

/// Half the size of the scene's Bounds, of which a tree holds millions; what is made of doubles is rounded outwards.
struct FloatBox {
    glm::vec3 low, high;
};

/// The points from + s · (to − from), 0 ≤ s ≤ `last` ≤ 1, each known to within `pad` per axis.
struct PaddedSegment {
    glm::dvec3 from, to, pad;
    double last = 1;
};

/// Whether the segment may meet the box.
bool mayMeet(const PaddedSegment& segment, const FloatBox& box);

/// Four numbers at a time, as compilers make one instruction of.
using Four = float __attribute__((vector_size(16)));

/// Of four boxes, by axis.
struct FourBoxes {
    std::array<Four, 3> low, high;
};

class Bvh {
public:
    Bvh() = default;
    explicit Bvh(const std::vector<FloatBox>& boxes);

    [[nodiscard]] bool empty() const { return order_.empty(); }
    [[nodiscard]] const FloatBox& bounds() const { return bounds_; }

    /// Calls `visit(primitive)` for every box that the segment may meet, roughly front to back, until it returns true.
    /// `visit` may shorten `segment.last`. True if stopped.
    template <typename Visit>
    bool visit(const PaddedSegment& segment, Visit&& visit) const {
        if (root_.count > 0) return visitLeaf(root_, visit);
        if (empty()) return false;
        const FloatSegment floats(segment, bounds_);
        std::array<Pending, maxPending> pending;
        std::size_t count = 0;
        pending[count++] = {root_, 0};
        while (count > 0) {
            const auto [part, entry] = pending[--count];
            if (entry > rounded(segment.last)) continue;
            if (part.count > 0) {
                if (visitLeaf(part, visit)) return true;
                continue;
            }
            const Node& node = nodes_[part.first];
            const Four entries = floats.entries(node.boxes, rounded(segment.last));
            const std::size_t farther = count; // those after it are of this node, the nearest last
            for (std::uint32_t child = 0; child < node.children; ++child) {
                if (!(entries[child] < FloatSegment::outside)) continue;
                std::size_t at = count++;
                for (; at > farther && pending[at - 1].entry < entries[child]; --at) pending[at] = pending[at - 1];
                pending[at] = {node.parts[child], entries[child]};
            }
        }
        return false;
    }

    /// Calls `visit(primitive)` for every primitive of a leaf whose box `region.meets` and all boxes that hold it.
    template <typename Region, typename Visit>
    void visitBoxes(const Region& region, Visit&& visit) const {
        if (empty() || !region.meets(bounds_)) return;
        std::array<Part, maxPending> pending;
        std::size_t count = 0;
        pending[count++] = root_;
        while (count > 0) {
            const Part part = pending[--count];
            if (part.count > 0) {
                for (std::uint32_t i = part.first; i < part.first + part.count; ++i) visit(order_[i]);
                continue;
            }
            const Node& node = nodes_[part.first];
            const std::array<bool, 4> met = region.meets(node.boxes);
            for (std::uint32_t child = 0; child < node.children; ++child)
                if (met[child]) pending[count++] = node.parts[child];
        }
    }

private:
    struct Part {
        std::uint32_t first; // first primitive of a leaf, else a node
        std::uint32_t count; // primitives; 0 for a node
    };

    struct Node {
        FourBoxes boxes; // of the children
        std::array<Part, 4> parts;
        std::uint32_t children;
    };

    template <typename Visit>
    bool visitLeaf(Part leaf, Visit&& visit) const {
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
            if (visit(order_[i])) return true;
        return false;
    }

    /// The part that a segment still has to visit, and where it enters it.
    struct Pending {
        Part part;
        float entry;
    };

    /// The segment as floats, padded by what their rounding can change.
    class FloatSegment {
    public:
        FloatSegment(const PaddedSegment& segment, const FloatBox& bounds);

        /// First parameters at which it may enter the boxes; `outside` where it cannot before `last`.
        [[nodiscard]] Four entries(const FourBoxes& boxes, float last) const {
            Four enter{}, leave = all(last);
            for (int axis = 0; axis < 3; ++axis) {
                const Four a = (boxes.low[axis] - low_[axis]) * inverse_[axis];
                const Four b = (boxes.high[axis] - high_[axis]) * inverse_[axis];
                const Four near = a < b ? a : b, far = a < b ? b : a;
                enter = near > enter ? near : enter;
                leave = far < leave ? far : leave;
            }
            return enter <= leave ? enter : all(outside);
        }

        static constexpr float outside = 2; // parameters end at 1

    private:
        static Four all(float value) { return Four{value, value, value, value}; }

        std::array<Four, 3> low_, high_; // from + pad, from − pad
        std::array<Four, 3> inverse_;    // of the direction
    };

    /// Not below `last`.
    static float rounded(double last) { return static_cast<float>(last) * (1 + 0x1p-22F); }

    class Builder;
    // The builder halves by count below depth 64, so a binary tree has at most 64 + 32 levels. A node holds two of them, and
    // leaves three of its children behind.
    static constexpr std::size_t maxPending = 48 * 3 + 4;

    FloatBox bounds_{};
    Part root_{};
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

} // namespace shadowbench::groundtruth::geometry
