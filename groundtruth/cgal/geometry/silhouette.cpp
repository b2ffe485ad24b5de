#include "groundtruth/cgal/geometry/silhouette.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace shadowbench::groundtruth::geometry {
namespace {

class ChainBuilder {
public:
    ChainBuilder(const TriangleInstance& instance, const MeshEdges& edges, const glm::dvec4& light, int threads)
        : mesh_(*instance.mesh), edges_(edges), light_(light), threads_(threads), vertices_(mesh_.positions.size()) {
        inParallelParts(vertices_.size(), threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) vertices_[i] = worldVertex(instance.world, mesh_.positions[i]);
        });
    }

    /// Only what lies above the plane and below the light is to remain.
    void clip(const Triangle& plane, bool reachesLight) {
        const int front = side(plane, light_);
        heights_.resize(vertices_.size());
        levels_.resize(vertices_.size(), 1);
        inParallelParts(vertices_.size(), threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                heights_[i] = static_cast<std::int8_t>(front * side(plane, glm::dvec4(vertices_[i], 1)));
                if (reachesLight) levels_[i] = static_cast<std::int8_t>(belowLight(plane, light_, vertices_[i]));
            }
        });
    }

    Chains build() {
        findFacing();
        edges_.forEachSum(facing_, [&](const MeshEdges::Edge& edge, int covers) { addChain(edge.low, edge.high, covers); });
        if (!heights_.empty()) addContacts();
        return std::move(chains_);
    }

private:
    /// Which triangles the light sees counter-clockwise (1) or clockwise (−1); 0 for those that cannot occlude, and for
    /// those seen edge-on, which cover nothing.
    void findFacing() {
        facing_.resize(mesh_.triangles.size());
        inParallelParts(facing_.size(), threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const glm::uvec3& t = mesh_.triangles[i];
                if (!reaches(heights_, t) || !reaches(levels_, t)) continue;
                facing_[i] = static_cast<std::int8_t>(side({vertices_[t.x], vertices_[t.y], vertices_[t.z]}, light_));
            }
        });
    }

    static bool reaches(const std::vector<std::int8_t>& signs, const glm::uvec3& t) {
        return signs.empty() || signs[t.x] > 0 || signs[t.y] > 0 || signs[t.z] > 0;
    }

    /// Counter-clockwise seen from the light.
    [[nodiscard]] glm::uvec3 turned(std::size_t triangle) const {
        const glm::uvec3& t = mesh_.triangles[triangle];
        return facing_[triangle] > 0 ? t : glm::uvec3(t.x, t.z, t.y);
    }

    /// The part of an edge that is neither below the plane nor above the light.
    void addChain(std::uint32_t low, std::uint32_t high, int covers) {
        if (heights_.empty()) {
            chains_.edges.push_back({vertex(low), vertex(high), covers, false});
            return;
        }
        if (heights_[low] + heights_[high] < 0 || levels_[low] + levels_[high] < 0) return;
        const bool atLightLevel = levels_[low] == 0 && levels_[high] == 0;
        chains_.edges.push_back({end(low, high), end(high, low), covers, atLightLevel});
    }

    /// The end of the edge from `here` to `there` at the side of `here`.
    [[nodiscard]] ChainPoint end(std::uint32_t here, std::uint32_t there) const {
        if (heights_[here] < 0) return {there, here, EdgePointKind::PlaneContact};
        if (levels_[here] < 0) return {there, here, EdgePointKind::LightContact};
        return vertex(here);
    }

    static ChainPoint vertex(std::uint32_t index) { return {index, index, EdgePointKind::Vertex}; }

    void addContacts() {
        for (std::size_t i = 0; i < facing_.size(); ++i) {
            if (facing_[i] == 0) continue;
            const glm::uvec3 t = turned(i);
            addContact(t, heights_, EdgePointKind::PlaneContact);
            addContact(t, levels_, EdgePointKind::LightContact);
            if (heights_[t.x] > 0 && heights_[t.y] > 0 && heights_[t.z] > 0) continue;
            chains_.grounded.push_back(static_cast<std::uint32_t>(i));
            for (int k = 0; k < 3; ++k) markResting(t[k], t[(k + 1) % 3]);
        }
    }

    /// Where triangles rest on the plane without passing through it, their edges may cancel; centres there are to be noticed
    /// all the same.
    void markResting(std::uint32_t a, std::uint32_t b) {
        if (heights_[a] != 0) return;
        chains_.edges.push_back({vertex(a), vertex(heights_[b] == 0 ? b : a), 0, false});
    }

    /// The line in which a triangle that passes through the receiver's plane or the light's level meets it closes the part
    /// that remains.
    void addContact(const glm::uvec3& t, const std::vector<std::int8_t>& signs, EdgePointKind kind) {
        if (signs[t.x] >= 0 && signs[t.y] >= 0 && signs[t.z] >= 0) return;
        ChainPoint leaves{}, returns{};
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            if (signs[a] > 0 && signs[b] < 0) leaves = {a, b, kind};
            if (signs[a] < 0 && signs[b] > 0) returns = {b, a, kind};
            if (signs[a] > 0 && signs[b] == 0) leaves = vertex(b);
            if (signs[a] == 0 && signs[b] > 0) returns = vertex(a);
        }
        chains_.edges.push_back({leaves, returns, 1, kind == EdgePointKind::LightContact});
    }

    const Mesh& mesh_;
    const MeshEdges& edges_;
    const glm::dvec4& light_;
    int threads_;
    std::vector<glm::dvec3> vertices_;
    std::vector<std::int8_t> heights_, levels_; // exact signs above the plane and below the light; empty: not clipped
    std::vector<std::int8_t> facing_;
    Chains chains_;
};

ShadowVertex shadowVertex(const TriangleInstance& instance, const ChainPoint& point, const ShadowProjection& projection) {
    const auto world = [&](std::uint32_t i) { return worldVertex(instance.world, instance.mesh->positions[i]); };
    if (point.kind == EdgePointKind::PlaneContact) // in one order, for edges to stay joined bit for bit
        return projection.contact(world(std::min(point.a, point.b)), world(std::max(point.a, point.b)));
    return projection.project(world(point.b));
}

EdgePoint edgePoint(const TriangleInstance& instance, const ChainPoint& point) {
    const std::vector<glm::vec3>& positions = instance.mesh->positions;
    const glm::dvec3 a = worldVertex(instance.world, positions[point.a]);
    return {a, point.kind == EdgePointKind::Vertex ? a : worldVertex(instance.world, positions[point.b]), point.kind};
}

} // namespace

Chains wholeChains(const TriangleInstance& instance, const MeshEdges& edges, const glm::dvec4& light, int threads) {
    return ChainBuilder(instance, edges, light, threads).build();
}

Chains clippedChains(const TriangleInstance& instance, const MeshEdges& edges, const glm::dvec4& light,
                     const Triangle& plane, int threads) {
    const auto corners = Bounds{glm::dvec3(instance.box.low), glm::dvec3(instance.box.high)}.corners();
    const bool reachesLight =
        std::ranges::any_of(corners, [&](const glm::dvec3& c) { return belowLight(plane, light, c) <= 0; });
    ChainBuilder builder(instance, edges, light, threads);
    builder.clip(plane, reachesLight);
    return builder.build();
}

SpatialEdge spatialEdge(const TriangleInstance& instance, const ChainEdge& edge) {
    return {edgePoint(instance, edge.from), edgePoint(instance, edge.to), edge.covers};
}

std::vector<SpatialEdge> borderOf(const TriangleInstance& instance, std::uint32_t triangle, const glm::dvec4& light,
                                  const Triangle& plane) {
    const std::vector<glm::vec3>& positions = instance.mesh->positions;
    const glm::uvec3& t = instance.mesh->triangles[triangle];
    TriangleInstance alone = instance;
    alone.mesh = std::make_shared<Mesh>(Mesh{{positions[t.x], positions[t.y], positions[t.z]}, {{0, 1, 2}}, false});
    std::vector<SpatialEdge> border;
    for (const ChainEdge& edge : clippedChains(alone, MeshEdges(*alone.mesh), light, plane, 1).edges)
        border.push_back(spatialEdge(alone, edge));
    return border;
}

ShadowEdge shadowEdge(const TriangleInstance& instance, const ChainEdge& edge, const ShadowProjection& projection) {
    return {shadowVertex(instance, edge.from, projection), shadowVertex(instance, edge.to, projection), edge.covers};
}

bool missesImage(const TriangleInstance& instance, const ChainEdge& edge, const ShadowProjection& projection) {
    const EdgePoint from = edgePoint(instance, edge.from), to = edgePoint(instance, edge.to);
    const std::array points{from.a, to.a, from.b, to.b};
    const bool whole = edge.from.kind == EdgePointKind::Vertex && edge.to.kind == EdgePointKind::Vertex;
    return projection.misses(std::span(points).first(whole ? 2 : 4));
}

std::vector<ShadowEdge> silhouette(const TriangleInstance& instance, const glm::dvec4& light,
                                   const ShadowProjection& projection) {
    std::vector<ShadowEdge> edges;
    for (const ChainEdge& edge : clippedChains(instance, MeshEdges(*instance.mesh), light, projection.receiver(), 1).edges)
        if (!edge.atLightLevel) edges.push_back(shadowEdge(instance, edge, projection));
    return edges;
}

} // namespace shadowbench::groundtruth::geometry
