// Exact primary hits.
#pragma once

#include "base/progress.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/contract/reference.h"

#include <optional>

namespace shadowbench::groundtruth::geometry {

/// The ray through a pixel's centre; its parameter is the distance along the camera's forward axis.
Ray pixelRay(const Camera& camera, int x, int y, glm::ivec2 size);
Ray pixelRay(const CameraRays& rays, int x, int y); // the same

/// What a ray of the camera hits: Surface::FacesAway or Receiver.
struct SeenPoint {
    TriangleName name;
    Surface surface;
};
std::optional<SeenPoint> seenAlong(const SceneTriangles& scene, const Camera& camera, const Light& light, const Ray& ray);

PrimaryHits tracePrimary(const SceneTriangles& scene, const Camera& camera, const Light& light, glm::ivec2 size, int threads,
                         const Progress& progress);

} // namespace shadowbench::groundtruth::geometry
