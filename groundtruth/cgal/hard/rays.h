// Exact hard-shadow labels by shadow rays.
#pragma once

#include "base/progress.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/contract/reference.h"

#include <optional>

namespace shadowbench::groundtruth::hard {

using namespace geometry;

/// Label of one receiver point: Blocks = shadowed, None = lit, Touches = exactly on a shadow edge. `receiver` is a triangle
/// whose plane contains the point.
Blocking shadowLabel(const SceneTriangles& scene, const ReceiverPoint& point, TriangleName receiver,
                     const glm::dvec4& light);

/// How many triangles lie between the point and the light; nothing if the segment touches the border of one.
std::optional<int> coverCount(const SceneTriangles& scene, const ReceiverPoint& point, TriangleName receiver,
                              const glm::dvec4& light);

/// Fills visibility and surface (OnEdge) of all receivers of `primary`. `light` is homogeneous.
void traceShadows(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size,
                  const PrimaryHits& primary, int threads, Reference& out, const Progress& progress);

} // namespace shadowbench::groundtruth::hard
