// The edges that can bound a shadow in the image, over all instances; what receivers share is computed once.
#pragma once

#include "base/progress.h"
#include "groundtruth/cgal/geometry/silhouette.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace shadowbench::groundtruth::hard {

using namespace geometry;

struct CastEdge {
    const TriangleInstance& instance;
    const ChainEdge& edge;
};

/// What casts shadows onto one plane.
class Casters {
public:
    /// `chains` of all instances, null where one casts no shadow.
    Casters(const SceneTriangles& scene, std::vector<std::shared_ptr<const Chains>> chains);

    [[nodiscard]] std::size_t edges() const { return first_.back(); }
    [[nodiscard]] CastEdge edge(std::size_t index) const;
    /// Calls `visit(index, edge)` for begin ≤ index < end.
    template <typename Visit>
    void forEachEdge(std::size_t begin, std::size_t end, const Visit& visit) const {
        for (std::size_t i = instanceOf(begin); begin < end; ++i)
            for (; begin < std::min(end, first_[i + 1]); ++begin)
                visit(begin, CastEdge{scene_.instances()[i], chains_[i]->edges[begin - first_[i]]});
    }

    /// Triangles that occlude and touch or cross the plane.
    [[nodiscard]] const std::vector<TriangleName>& grounded() const { return grounded_; }

private:
    [[nodiscard]] std::size_t instanceOf(std::size_t edge) const;

    const SceneTriangles& scene_;
    std::vector<std::shared_ptr<const Chains>> chains_;
    std::vector<std::size_t> first_; // edge of each instance, and their number
    std::vector<TriangleName> grounded_;
};

/// Const use is thread-safe.
class Occluders {
public:
    /// `scene` must live longer; `light` is homogeneous.
    Occluders(const SceneTriangles& scene, const glm::dvec4& light, int threads);

    /// Casters onto the plane of `projection`, but for instances whose shadows on it miss the image. Ordered by instance.
    [[nodiscard]] Casters castersOnto(const ShadowProjection& projection, const Progress& progress) const;

    [[nodiscard]] const SceneTriangles& scene() const { return scene_; }
    [[nodiscard]] const glm::dvec4& light() const { return light_; }
    [[nodiscard]] int threads() const { return threads_; }

private:
    /// Chains of an instance that no receiver has cut yet, made when first needed.
    struct Whole {
        std::once_flag made;
        std::shared_ptr<const Chains> chains;
    };
    /// Edges of a distinct mesh, found when first needed.
    struct Edges {
        std::once_flag found;
        MeshEdges edges;
    };
    const MeshEdges& edgesOf(const TriangleInstance& instance) const;
    std::shared_ptr<const Chains> chainsOf(std::size_t instance, const ShadowProjection& projection, int threads) const;

    const SceneTriangles& scene_;
    glm::dvec4 light_;
    int threads_;
    mutable std::deque<Edges> edges_; // one per TriangleInstance::tree
    mutable std::deque<Whole> whole_; // one per instance
};

} // namespace shadowbench::groundtruth::hard
