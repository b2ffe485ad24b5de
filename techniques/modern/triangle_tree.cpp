#include "techniques/modern/triangle_tree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <span>

namespace shadowbench::techniques {
namespace {

struct Box {
    glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

class Builder {
public:
    explicit Builder(const Snapshot& snapshot) {
        for (const Batch& batch : snapshot.batches)
            for (const Placement& placement : batch.placements) addMesh(*batch.mesh, placement.world);
        std::vector<std::uint32_t> all(tree_.corners.size() / 3);
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        tree_.nodes.reserve(2 * all.size());
        if (!all.empty()) addNode(all);
    }

    TriangleTree take() { return std::move(tree_); }

private:
    void addMesh(const Mesh& mesh, const glm::dmat4& world) {
        for (const glm::uvec3& triangle : mesh.triangles)
            for (int corner = 0; corner < 3; ++corner)
                tree_.corners.emplace_back(world * glm::dvec4(glm::dvec3(mesh.positions[triangle[corner]]), 1));
    }

    [[nodiscard]] glm::vec3 corner(std::uint32_t triangle, std::uint32_t which) const {
        return tree_.corners[3 * triangle + which];
    }

    [[nodiscard]] glm::vec3 middle(std::uint32_t triangle) const {
        return corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2); // times three: only their order counts
    }

    void addNode(std::span<std::uint32_t> triangles) {
        Box box, middles;
        for (const std::uint32_t triangle : triangles) {
            for (std::uint32_t which = 0; which < 3; ++which) box.add(corner(triangle, which));
            middles.add(middle(triangle));
        }
        const std::size_t number = tree_.nodes.size();
        tree_.nodes.push_back({box.low, 0, box.high, triangles.size() == 1 ? triangles.front() + 1 : 0});
        if (triangles.size() > 1) addHalves(triangles, middles.high - middles.low);
        tree_.nodes[number].after = static_cast<std::uint32_t>(tree_.nodes.size());
    }

    void addHalves(std::span<std::uint32_t> triangles, const glm::vec3& spread) {
        const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
        const std::size_t half = triangles.size() / 2;
        std::ranges::nth_element(triangles, triangles.begin() + static_cast<std::ptrdiff_t>(half), {},
                                 [&](std::uint32_t triangle) { return middle(triangle)[axis]; });
        addNode(triangles.first(half));
        addNode(triangles.subspan(half));
    }

    TriangleTree tree_;
};

} // namespace

TriangleTree treeOver(const Snapshot& snapshot) { return Builder(snapshot).take(); }

} // namespace shadowbench::techniques
