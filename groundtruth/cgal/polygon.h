// Exact hard-shadow labels and edge distances on one plane, from silhouettes.
#pragma once

#include "groundtruth/cgal/exact.h"
#include "groundtruth/cgal/triangles.h"

namespace shadowbench::groundtruth {

/// Fills visibility, surface and edgeDistance of the pixels that see `receiver`. `light` is homogeneous.
void labelPlane(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size,
                const PrimaryHits& primary, const PlanarReceiver& receiver, int threads, Reference& out,
                const Progress& progress);

} // namespace shadowbench::groundtruth
