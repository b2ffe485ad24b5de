// Which visible receivers are planar.
#pragma once

#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/hard/exact.h"

namespace shadowbench::groundtruth::hard {

using namespace geometry;

std::vector<PlanarReceiver> findPlanarReceivers(const SceneTriangles& scene, const glm::dvec3& eye,
                                                const PrimaryHits& primary, std::size_t minimumPixels);

} // namespace shadowbench::groundtruth::hard
