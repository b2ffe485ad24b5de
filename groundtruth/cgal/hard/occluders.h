// The edges that can bound a shadow in the image, over all instances; what receivers share is computed once.
#pragma once

#include "base/progress.h"
#include "groundtruth/cgal/geometry/silhouette.h"

#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace shadowbench::groundtruth::hard {

using namespace geometry;

struct CastEdge {
    std::uint32_t instance;
    ChainEdge edge;
};

/// What casts shadows onto one plane.
struct Casters {
    std::vector<CastEdge> edges;
    std::vector<TriangleName> grounded; // triangles that occlude and touch or cross the plane
};

/// Const use is thread-safe.
class Occluders {
public:
    /// `scene` must live longer; `light` is homogeneous.
    Occluders(const SceneTriangles& scene, const glm::dvec4& light, int threads);

    /// Casters onto the plane of `projection`, but for instances whose shadows on it miss the image. Ordered by instance.
    [[nodiscard]] Casters castersOnto(const ShadowProjection& projection, glm::ivec2 size, const Progress& progress) const;

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
    std::shared_ptr<const Chains> chainsOf(std::size_t instance, const ShadowProjection& projection, glm::ivec2 size,
                                           int threads) const;

    const SceneTriangles& scene_;
    glm::dvec4 light_;
    int threads_;
    mutable std::deque<Edges> edges_; // one per TriangleInstance::tree
    mutable std::deque<Whole> whole_; // one per instance
};

} // namespace shadowbench::groundtruth::hard
