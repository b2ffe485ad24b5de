// The distinct edges of a mesh and the triangles at each: the same for all instances and lights.
#pragma once

#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace shadowbench::groundtruth::geometry {

class MeshEdges {
public:
    MeshEdges() = default;
    explicit MeshEdges(const Mesh& mesh);

    struct Edge {
        std::uint32_t low, high; // vertices, low < high
        std::uint32_t firstUse;  // its uses end where those of the next edge begin
    };
    /// A triangle at an edge: twice its index, plus 1 if it runs from low to high.
    using Use = std::uint32_t;

    /// Calls `visit(edge, covers)` for every edge at which the sum of the triangles' signs, taken in the direction from low
    /// to high, is not 0. `signs` holds a number for each triangle.
    template <typename Sign, typename Visit>
    void forEachSum(const std::vector<Sign>& signs, const Visit& visit) const {
        for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
            int covers = 0;
            for (std::uint32_t use = edges_[i].firstUse; use < edges_[i + 1].firstUse; ++use)
                covers += uses_[use] % 2 == 1 ? signs[uses_[use] / 2] : -signs[uses_[use] / 2];
            if (covers != 0) visit(edges_[i], covers);
        }
    }

private:
    std::vector<Edge> edges_; // ordered by low; and one more that ends the uses
    std::vector<Use> uses_;
};

} // namespace shadowbench::groundtruth::geometry
