// How far a scene moves from one frame to the next.
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench::metrics {
namespace {

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// The direction of an image position in the camera's own axes.
glm::dvec3 inCamera(const Camera& camera, const Camera::Basis& axes, glm::dvec2 position, glm::ivec2 size) {
    const glm::dvec3 ray = camera.ray(position, size);
    return {glm::dot(ray, axes.right), glm::dot(ray, axes.up), glm::dot(ray, axes.forward)};
}

/// From a point towards a light's centre.
glm::dvec3 towards(const Light& light, const glm::dvec3& point) {
    const glm::dvec4 place = light.centreOnly().homogeneous();
    return glm::dvec3(place) - place.w * point;
}

/// The largest angle at `point` that a corner of a moving mesh's bounds turns, by its placement or as it deforms.
double ofCasters(const Snapshot& now, const glm::dvec3& point) {
    double largest = 0;
    for (const Batch& batch : now.batches) {
        if (!batch.moving) continue;
        const std::array<glm::dvec3, 8> corners = batch.mesh->bounds().corners(),
                                        were = (batch.previousMesh ? batch.previousMesh : batch.mesh)->bounds().corners();
        for (const Placement& placement : batch.placements)
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const glm::dvec3 here(placement.world * glm::dvec4(corners[i], 1));
                const glm::dvec3 before(placement.previous * glm::dvec4(were[i], 1));
                largest = std::max(largest, degreesBetween(here - point, before - point));
            }
    }
    return largest;
}

} // namespace

double motion(const Snapshot& now, const Light& before, const groundtruth::Reference& truth, const Image<glm::vec2>& warp) {
    const glm::ivec2 size(warp.width(), warp.height());
    const Camera::Basis axes = now.camera.basis(), previousAxes = now.previousCamera.basis();
    double turned = 0, pixels = 0;
    glm::dvec3 middle(0);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (!isSomewhere(warp(x, y))) continue;
            turned += degreesBetween(inCamera(now.camera, axes, {x + 0.5, y + 0.5}, size),
                                     inCamera(now.previousCamera, previousAxes, glm::dvec2(warp(x, y)), size));
            middle += glm::dvec3(truth.position(x, y));
            ++pixels;
        }
    if (pixels == 0) return 0;
    middle /= pixels;
    return turned / pixels + degreesBetween(towards(now.light, middle), towards(before, middle)) + ofCasters(now, middle);
}

} // namespace shadowbench::metrics
