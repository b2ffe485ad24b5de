// Scenes under environment light whose shadows have a closed form.
#pragma once

#include "scene/sky.h"
#include "tests/support/models/radiance_transfer.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

namespace shadowbench {

inline Scene under(Scene scene, EnvironmentLight environment) {
    scene.light = environmentLight(std::move(environment));
    return scene;
}

/// A sun in a black sky.
inline EnvironmentLight sunAlone(double diameter, const glm::dvec3& direction = {0, 1, 0}) {
    return {ConstantSky{0}, {{glm::normalize(direction), diameter, 1}}};
}

/// `count` suns of one radiance on a spiral over the sky.
inline std::vector<Sun> manySuns(int count) {
    std::vector<Sun> suns;
    for (int i = 0; i < count; ++i) {
        const double turn = 2.4 * i, height = 0.3 + 0.7 * (i + 0.5) / count;
        const double radius = std::sqrt(1 - height * height);
        suns.push_back({{radius * std::cos(turn), height, radius * std::sin(turn)}, 5, 1});
    }
    return suns;
}

/// The slab of groundScene() under a thin plate of 3 × 2 m, 1.5 m above it.
inline Scene plateUnderSky(int side = 96) {
    Scene scene = groundScene(side);
    scene.objects.push_back(object(box({3, 0.002, 2}), {0.13, 1.501, 0.21}));
    return under(scene, {ConstantSky{1}, {}});
}

/// Share of a constant sky that the plate leaves to a point of the slab: 1 less the form factor of a parallel rectangle.
inline double plateVisibility(const glm::dvec3& p) {
    const auto corner = [](double x, double y) {
        const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
        return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / glm::two_pi<double>();
    };
    const double height = 1.5;
    const double x0 = (0.13 - 1.5 - p.x) / height, x1 = (0.13 + 1.5 - p.x) / height;
    const double z0 = (0.21 - 1 - p.z) / height, z1 = (0.21 + 1 - p.z) / height;
    return 1 - (corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0));
}

/// The slab and edge of halfPlaneScene(), cut to what the camera and a sun near the zenith see of them: points lie closer.
inline Scene edgeUnderSun(const EnvironmentLight& light, int side = 96) {
    Scene scene = halfPlaneScene(side);
    scene.objects[0] = object(box({5, 0.2, 5}), {0, -0.1, 0});
    scene.objects[1] = object(box({3, 0.002, 6}), {1.8, 2.001, 0});
    return under(scene, light);
}

/// The slab's points of edgeUnderSun() within 1.5 m of the edge above, with the share of the first sun's light as their
/// truth: its light passes beside the plate's edge x = 0.3 or is blocked.
inline std::vector<SlabPoint> sunPoints(const Stage& stage, const Image<float>& v) {
    const Sun& sun = stage.shown().light.environment->suns.front();
    std::vector<SlabPoint> points;
    for (SlabPoint point : slabPoints(stage, v)) {
        if (std::abs(point.at.x - 0.3) > 1.5 || std::abs(point.at.z) > 1.5) continue;
        point.truth = models::sunVisibility(
            sun, {0, 1, 0}, [&](const glm::dvec3& direction) { return point.at.x + direction.x / direction.y * 2 > 0.3; });
        points.push_back(point);
    }
    return points;
}

inline double sunRmsError(Stage& stage, const std::string& variant) {
    return rmsError(sunPoints(stage, rendered(stage, variant)));
}

} // namespace shadowbench
