#include "groundtruth/cgal/silhouette.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace shadowbench::groundtruth {
namespace {

/// An undirected mesh edge with the covers of its direction from the lower to the higher vertex index, kept by lower index.
struct Chain {
    std::uint32_t high;
    int covers;
};

class SilhouetteBuilder {
public:
    SilhouetteBuilder(const TriangleInstance& instance, const glm::dvec4& light,
                      const std::function<int(const glm::dvec3&)>& height)
        : mesh_(*instance.mesh), light_(light) {
        vertices_.reserve(mesh_.positions.size());
        for (const glm::vec3& position : mesh_.positions) vertices_.push_back(worldVertex(instance.world, position));
        heights_.reserve(vertices_.size());
        for (const glm::dvec3& vertex : vertices_) heights_.push_back(static_cast<std::int8_t>(height(vertex)));
    }

    std::vector<SilhouetteEdge> build() {
        if (std::ranges::none_of(heights_, [](int h) { return h > 0; })) return {};
        turnTowardsLight();
        sumChains();
        for (const glm::uvec3& t : triangles_) addContact(t);
        return std::move(edges_);
    }

private:
    /// The triangles that can occlude, counter-clockwise seen from the light; those seen edge-on cover nothing.
    void turnTowardsLight() {
        triangles_.reserve(mesh_.triangles.size());
        for (glm::uvec3 t : mesh_.triangles) {
            if (heights_[t.x] <= 0 && heights_[t.y] <= 0 && heights_[t.z] <= 0) continue;
            const int facing = side({vertices_[t.x], vertices_[t.y], vertices_[t.z]}, light_);
            if (facing == 0) continue;
            if (facing < 0) std::swap(t.y, t.z);
            triangles_.push_back(t);
        }
    }

    /// Adds ±1 per directed edge, bucketed by the lower vertex index, and keeps what does not cancel.
    void sumChains() {
        std::vector<std::uint32_t> first(vertices_.size() + 1, 0);
        forEachEdge([&](std::uint32_t low, std::uint32_t, int) { ++first[low + 1]; });
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        std::vector<std::uint32_t> last(first.begin(), first.end() - 1);
        std::vector<Chain> chains(first.back());
        forEachEdge([&](std::uint32_t low, std::uint32_t high, int covers) {
            const auto begin = chains.begin() + first[low], end = chains.begin() + last[low];
            const auto found = std::find_if(begin, end, [&](const Chain& c) { return c.high == high; });
            if (found == end)
                chains[last[low]++] = {high, covers};
            else
                found->covers += covers;
        });
        for (std::uint32_t low = 0; low < vertices_.size(); ++low)
            for (std::uint32_t i = first[low]; i < last[low]; ++i)
                if (chains[i].covers != 0) addChain(low, chains[i]);
    }

    template <typename Visit>
    void forEachEdge(const Visit& visit) const {
        for (const glm::uvec3& t : triangles_)
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t a = t[i], b = t[(i + 1) % 3];
                visit(std::min(a, b), std::max(a, b), a < b ? 1 : -1);
            }
    }

    /// The part of an edge that is not below the plane.
    void addChain(std::uint32_t low, const Chain& chain) {
        const int a = heights_[low], b = heights_[chain.high];
        if (a + b < 0) return;
        const SilhouettePoint from = a < 0 ? contact(low, chain.high) : vertex(low);
        const SilhouettePoint to = b < 0 ? contact(low, chain.high) : vertex(chain.high);
        edges_.push_back({from, to, chain.covers});
    }

    /// The line in which a triangle that passes through the plane meets it closes the part above.
    void addContact(const glm::uvec3& t) {
        if (heights_[t.x] >= 0 && heights_[t.y] >= 0 && heights_[t.z] >= 0) return;
        SilhouettePoint leaves{}, returns{};
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            if (heights_[a] > 0 && heights_[b] < 0) leaves = contact(a, b);
            if (heights_[a] < 0 && heights_[b] > 0) returns = contact(a, b);
            if (heights_[a] > 0 && heights_[b] == 0) leaves = vertex(b);
            if (heights_[a] == 0 && heights_[b] > 0) returns = vertex(a);
        }
        edges_.push_back({leaves, returns, 1});
    }

    [[nodiscard]] SilhouettePoint vertex(std::uint32_t a) const { return {vertices_[a], std::nullopt}; }

    [[nodiscard]] SilhouettePoint contact(std::uint32_t a, std::uint32_t b) const {
        return {vertices_[std::min(a, b)], vertices_[std::max(a, b)]};
    }

    const Mesh& mesh_;
    const glm::dvec4& light_;
    std::vector<glm::dvec3> vertices_;
    std::vector<std::int8_t> heights_; // exact signs
    std::vector<glm::uvec3> triangles_;
    std::vector<SilhouetteEdge> edges_;
};

ShadowVertex project(const SilhouettePoint& point, const ShadowProjection& projection) {
    return point.other ? projection.contact(point.vertex, *point.other) : projection.project(point.vertex);
}

} // namespace

std::vector<SilhouetteEdge> silhouetteEdges(const TriangleInstance& instance, const glm::dvec4& light,
                                            const std::function<int(const glm::dvec3&)>& height) {
    return SilhouetteBuilder(instance, light, height).build();
}

std::vector<ShadowEdge> silhouette(const TriangleInstance& instance, const glm::dvec4& light,
                                   const ShadowProjection& projection) {
    const auto height = [&](const glm::dvec3& vertex) { return projection.height(vertex); };
    std::vector<ShadowEdge> shadow;
    for (const SilhouetteEdge& edge : silhouetteEdges(instance, light, height))
        shadow.push_back({project(edge.from, projection), project(edge.to, projection), edge.covers});
    return shadow;
}

} // namespace shadowbench::groundtruth
