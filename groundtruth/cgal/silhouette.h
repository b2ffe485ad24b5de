// Silhouette chains: of all edges of an occluder only those remain at which the number of covering triangles changes.
#pragma once

#include "groundtruth/cgal/projection.h"
#include "groundtruth/cgal/triangles.h"

#include <vector>

namespace shadowbench::groundtruth {

/// A directed edge of the shadow: to its left, seen from the light, `covers` more triangles lie than to its right.
struct ShadowEdge {
    ShadowVertex from, to;
    int covers;
};

/// The silhouette and border edges of one instance as the light sees the part of it above the receiver's plane. Their
/// winding number is the number of triangles between a point of the plane and the light, for closed, open and broken meshes
/// alike.
std::vector<ShadowEdge> silhouette(const TriangleInstance& instance, const glm::dvec4& light,
                                   const ShadowProjection& projection);

} // namespace shadowbench::groundtruth
