// The half-plane scene under a light that is tilted about the plate's edge: slab and plate lie at a slant in a map from it.
#pragma once

#include "tests/support/soft_scenes.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

namespace shadowbench {

/// The light turned by so many degrees towards the plate, about its centre and the direction of the plate's edge.
inline Scene tiltedLightScene(double degrees, int side = 96) {
    Scene scene = halfPlaneScene(side);
    const double angle = glm::radians(degrees);
    scene.light.u = 1.5 * glm::dvec3(std::cos(angle), std::sin(angle), 0);
    return scene;
}

/// The share of the light on this side of the plane through a point of the slab and the plate's lower edge.
inline double tiltedLightVisibility(const Light& light, const glm::dvec3& p) {
    const glm::dvec2 toEdge(0.3 - p.x, 2 - p.y), toCentre(light.centre.x - p.x, light.centre.y - p.y);
    const auto cross = [&](const glm::dvec2& a) { return a.x * toEdge.y - a.y * toEdge.x; };
    return std::clamp(0.5 - cross(toCentre) / cross(glm::dvec2(light.u)), 0.0, 1.0);
}

/// The slab's points with that truth.
inline std::vector<SlabPoint> tiltedLightPoints(const Stage& stage, const Image<float>& v) {
    std::vector<SlabPoint> points;
    for (SlabPoint point : slabPoints(stage, v)) {
        point.truth = tiltedLightVisibility(stage.shown().light, point.at);
        points.push_back(point);
    }
    return points;
}

} // namespace shadowbench
