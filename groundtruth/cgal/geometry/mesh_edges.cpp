#include "groundtruth/cgal/geometry/mesh_edges.h"

#include <algorithm>
#include <iterator>

namespace shadowbench::groundtruth::geometry {
namespace {

struct DirectedEdge {
    std::uint32_t high;
    MeshEdges::Use use;
};

/// Calls `visit(low, directed edge)` for the three edges of every triangle.
template <typename Visit>
void forEachDirected(const Mesh& mesh, const Visit& visit) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
            visit(std::min(a, b), DirectedEdge{std::max(a, b), 2 * i + (a < b ? 1U : 0U)});
        }
}

} // namespace

/// Buckets the directed edges by their lower vertex and orders each bucket, which is small, by the higher one.
MeshEdges::MeshEdges(const Mesh& mesh) {
    std::vector<std::uint32_t> end(mesh.positions.size() + 1, 0);
    forEachDirected(mesh, [&](std::uint32_t low, const DirectedEdge&) { ++end[low + 1]; });
    for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
    std::vector<DirectedEdge> buckets(end.back());
    forEachDirected(mesh, [&](std::uint32_t low, const DirectedEdge& edge) { buckets[end[low]++] = edge; });

    uses_.reserve(buckets.size());
    edges_.reserve(buckets.size() / 2 + 1);
    std::uint32_t begin = 0; // `end` now holds where each bucket ends
    for (std::uint32_t low = 0; low < mesh.positions.size(); ++low) {
        const auto first = buckets.begin() + begin, last = buckets.begin() + end[low];
        std::sort(first, last, [](const DirectedEdge& a, const DirectedEdge& b) { return a.high < b.high; });
        for (auto edge = first; edge != last; ++edge) {
            if (edge == first || edge->high != std::prev(edge)->high)
                edges_.push_back({low, edge->high, static_cast<std::uint32_t>(uses_.size())});
            uses_.push_back(edge->use);
        }
        begin = end[low];
    }
    edges_.push_back({0, 0, static_cast<std::uint32_t>(uses_.size())});
}

} // namespace shadowbench::groundtruth::geometry
