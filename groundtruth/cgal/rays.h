// Exact hard-shadow labels by shadow rays.
#pragma once

#include "groundtruth/cgal/triangles.h"
#include "groundtruth/reference.h"

namespace shadowbench::groundtruth {

/// Fills visibility and surface (OnEdge) of all receivers of `primary`. `light` is homogeneous.
void traceShadows(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size,
                  const PrimaryHits& primary, int threads, Reference& out, const Progress& progress);

} // namespace shadowbench::groundtruth
