// What arrives of an environment light, each direction decided exactly.
#pragma once

#include "base/image.h"
#include "groundtruth/contract/reference.h"
#include "scene/sky_sampler.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>

namespace shadowbench::groundtruth::geometry {
class SceneTriangles; // groundtruth/cgal/geometry/triangles.h
}

namespace shadowbench::groundtruth::hard {

/// The normals of the triangles that `primary`, of this snapshot, sees: unit length, on the side of the eye; 0 for
/// background.
Image<glm::dvec3> seenNormals(const Snapshot& snapshot, const geometry::SceneTriangles& triangles,
                              const PrimaryHits& primary);

/// Sums over directions, each weighed by its irradiance and the cosine of its angle to the normal; directions below the
/// tangent plane count nowhere.
struct Irradiance {
    double arriving = 0;   // from directions in which no triangle lies, or only the border of one
    double unoccluded = 0; // from all
};

/// A snapshot prepared for queries; const use is thread-safe.
class ExactSky {
public:
    /// With triangles that were made of the same snapshot, or of one with another camera and light only.
    ExactSky(const Snapshot& snapshot, std::shared_ptr<const geometry::SceneTriangles> triangles)
        : camera_(snapshot.camera), triangles_(std::move(triangles)) {}

    /// At the exact surface point that `pixel` of `primary` sees. Throws InternalError where it sees none.
    [[nodiscard]] Irradiance irradiance(glm::ivec2 pixel, const PrimaryHits& primary,
                                        std::span<const SkyDirection> directions) const;

private:
    Camera camera_;
    std::shared_ptr<const geometry::SceneTriangles> triangles_;
};

} // namespace shadowbench::groundtruth::hard
