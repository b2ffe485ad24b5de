// Silhouette chains: of all edges of an occluder only those remain at which the number of covering triangles changes.
#pragma once

#include "groundtruth/cgal/projection.h"
#include "groundtruth/cgal/triangles.h"

#include <functional>
#include <optional>
#include <vector>

namespace shadowbench::groundtruth {

/// A point of an occluder: a vertex, or where the edge between two vertices passes through the receiver's plane.
struct SilhouettePoint {
    glm::dvec3 vertex;
    std::optional<glm::dvec3> other; // the edge's other end, on the other side of the plane
};

/// A directed edge of an occluder: to its left, seen from the light, `covers` more triangles lie than to its right.
struct SilhouetteEdge {
    SilhouettePoint from, to;
    int covers;
};

/// The silhouette and border edges of one instance as the light sees the part of it above the receiver's plane. `height`
/// gives the exact sign of a vertex's height above that plane, positive on the light's side.
std::vector<SilhouetteEdge> silhouetteEdges(const TriangleInstance& instance, const glm::dvec4& light,
                                            const std::function<int(const glm::dvec3&)>& height);

/// The shadow of a silhouette edge.
struct ShadowEdge {
    ShadowVertex from, to;
    int covers;
};

/// The silhouette edges of one instance, projected. Their winding number is the number of triangles between a point of the
/// plane and the light, for closed, open and broken meshes alike.
std::vector<ShadowEdge> silhouette(const TriangleInstance& instance, const glm::dvec4& light,
                                   const ShadowProjection& projection);

} // namespace shadowbench::groundtruth
