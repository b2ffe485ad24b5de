#include "techniques/modern/triangle_tree.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <span>

namespace shadowbench::techniques {
namespace {

struct Box {
    glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    [[nodiscard]] float halfArea() const {
        const glm::vec3 size = high - low;
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

struct Leaf {
    Box box;
    glm::vec3 middle;
    std::uint32_t triangle;
};

/// Leaves whose middles lie in one slice of an axis.
struct Slice {
    Box box;
    float leaves = 0;

    void add(const Slice& other) {
        box.add(other.box);
        leaves += other.leaves;
    }
    /// By the surface area heuristic (Goldsmith, Salmon 1987): as many leaves as there are, as often as a ray meets the box.
    [[nodiscard]] float cost() const { return leaves == 0 ? 0 : box.halfArea() * leaves; }
};

/// Middles in the first `slices` of an axis come first.
struct Cut {
    static constexpr int all = 16; // slices of an axis (Wald 2007)

    int axis = 0, slices = 0;
    float low = 0, size = 0; // of all middles along the axis

    [[nodiscard]] int sliceOf(const Leaf& leaf) const {
        return std::min(static_cast<int>(all * (leaf.middle[axis] - low) / size), all - 1);
    }
    [[nodiscard]] bool holds(const Leaf& leaf) const { return sliceOf(leaf) < slices; }
};

/// Nothing where all middles are the same.
std::optional<Cut> cheapestCut(std::span<const Leaf> leaves) {
    Box middles;
    for (const Leaf& leaf : leaves) middles.add({leaf.middle, leaf.middle});
    std::optional<Cut> best;
    float least = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        Cut cut{axis, 0, middles.low[axis], middles.high[axis] - middles.low[axis]};
        if (!(cut.size > 0)) continue;
        std::array<Slice, Cut::all> slices;
        for (const Leaf& leaf : leaves) slices[static_cast<std::size_t>(cut.sliceOf(leaf))].add({leaf.box, 1});
        std::array<Slice, Cut::all> behind = slices;
        for (std::size_t i = behind.size() - 1; i-- > 0;) behind[i].add(behind[i + 1]);
        Slice before;
        for (cut.slices = 1; cut.slices < Cut::all; ++cut.slices) {
            const auto next = static_cast<std::size_t>(cut.slices);
            before.add(slices[next - 1]);
            const float cost = before.cost() + behind[next].cost();
            if (before.leaves == 0 || behind[next].leaves == 0 || !(cost < least)) continue;
            least = cost;
            best = cut;
        }
    }
    return best;
}

class Builder {
public:
    explicit Builder(const Snapshot& snapshot) {
        for (const Batch& batch : snapshot.batches)
            for (const Placement& placement : batch.placements) addMesh(*batch.mesh, placement.world);
        std::vector<Leaf> leaves;
        for (std::uint32_t triangle = 0; triangle < tree_.corners.size() / 3; ++triangle) {
            Box box;
            for (std::uint32_t which = 0; which < 3; ++which) {
                const glm::vec3 corner(tree_.corners[3 * triangle + which]);
                box.add({corner, corner});
            }
            leaves.push_back({box, 0.5F * (box.low + box.high), triangle});
        }
        tree_.nodes.reserve(2 * leaves.size());
        if (!leaves.empty()) addNode(leaves);
    }

    TriangleTree take() { return std::move(tree_); }

private:
    void addMesh(const Mesh& mesh, const glm::dmat4& world) {
        for (const glm::uvec3& triangle : mesh.triangles)
            for (int corner = 0; corner < 3; ++corner)
                tree_.corners.emplace_back(world * glm::dvec4(glm::dvec3(mesh.positions[triangle[corner]]), 1));
    }

    void addNode(std::span<Leaf> leaves) {
        Box box;
        for (const Leaf& leaf : leaves) box.add(leaf.box);
        const std::size_t number = tree_.nodes.size();
        tree_.nodes.push_back({box.low, 0, box.high, leaves.size() == 1 ? leaves.front().triangle + 1 : 0});
        if (leaves.size() > 1) addParts(leaves);
        tree_.nodes[number].after = static_cast<std::uint32_t>(tree_.nodes.size());
    }

    void addParts(std::span<Leaf> leaves) {
        std::size_t first = leaves.size() / 2;
        if (const std::optional<Cut> cut = cheapestCut(leaves))
            first =
                leaves.size() - std::ranges::partition(leaves, [&](const Leaf& leaf) { return cut->holds(leaf); }).size();
        addNode(leaves.first(first));
        addNode(leaves.subspan(first));
    }

    TriangleTree tree_;
};

} // namespace

TriangleTree treeOver(const Snapshot& snapshot) { return Builder(snapshot).take(); }

} // namespace shadowbench::techniques
