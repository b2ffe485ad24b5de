// Logarithmic perspective maps against closed forms.
#include "techniques/maps/sm-log/log_view.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "tests/support/light_views.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

TEST(LogView, TheCentreOfTheWarpIsTheEyeForALightPerpendicularToTheView) {
    EXPECT_NEAR(logNear(48, 1, 49), 1, 1e-12);
    EXPECT_NEAR(logNear(48 / std::sin(0.7), 1, 49), 1 / std::sin(0.7),
                1e-12); // slanted: as much farther as the range is longer
}

TEST(LogView, HardlyWarpsWhereDepthDoesNotGrow) {
    EXPECT_EQ(logNear(5, 3, 3), 100);
    EXPECT_EQ(logNear(5, -1, 3), 100);
}

/// How many times the map moves on, of its side, while a point of the slab's top moves by as much as it is far from the eye.
double samplingAt(const LogView& view, double depth, const glm::dvec3& direction) {
    const glm::dvec3 p(0.1 * depth, 0.05, 10 - depth), step = 1e-5 * depth * direction;
    return glm::distance(texelAt(view, p + step, 1).value(), texelAt(view, p - step, 1).value()) / 2e-5;
}

TEST(LogView, SamplingIsTheSameAtAllDepthsAlongBothAxes) {
    const Light overhead = sun({0, -1, 0});
    const Snapshot scene = slabScene(overhead);
    const LogView view = fitLog(overhead, scene, scene.camera, 1);
    const double z0 = 1.95 / std::tan(glm::radians(30.0)), z1 = 20; // where the frustum meets the slab, and the slab's end
    for (const double depth : {1.1 * z0, 5.0, 9.0, 0.98 * z1}) {
        EXPECT_NEAR(samplingAt(view, depth, {0, 0, 1}) * std::log(z1 / z0), 1, 0.03) << depth;
        // Its sides are those of the frustum.
        EXPECT_NEAR(samplingAt(view, depth, {1, 0, 0}) * 2 * std::tan(glm::radians(30.0)), 1, 0.1) << depth;
    }
}

/// The same of a perspective map.
double samplingAt(const LightView& view, double depth, const glm::dvec3& direction) {
    const glm::dvec3 p(0.1 * depth, 0.05, 10 - depth), step = 1e-5 * depth * direction;
    return 0.5 * glm::distance(glm::dvec2(mapped(view, p + step)), glm::dvec2(mapped(view, p - step))) / 2e-5;
}

TEST(LogView, TheLargestErrorOverALongRangeIsAFractionOfLispsms) {
    const Light overhead = sun({0, -1, 0});
    Snapshot scene = slabScene(overhead);
    const glm::dmat4 stretched(glm::dvec4(10, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 10, 0),
                               glm::dvec4(0, 0, -90, 1));
    scene.batches[0].placements[0].world = stretched; // 200 m
    scene.camera.far = 250;
    const LogView logarithmic = fitLog(overhead, scene, scene.camera, 1);
    const LightView perspective = fitLispsm(overhead, scene, scene.camera, 1);
    const double z0 = 1.95 / std::tan(glm::radians(30.0)), z1 = 200, r = z1 / z0;
    const auto least = [&](const auto& view, const glm::dvec3& direction) {
        double worst = 1e30;
        for (double depth = 1.01 * z0; depth < 0.99 * z1; depth *= 1.05)
            worst = std::min(worst, samplingAt(view, depth, direction));
        return worst;
    };
    // Along the view 1 / ln r against √r / (r − 1), across it 1 against 1 / √r.
    EXPECT_NEAR(least(logarithmic, {0, 0, 1}) / least(perspective, {0, 0, 1}), (r - 1) / (std::sqrt(r) * std::log(r)), 0.2);
    EXPECT_NEAR(least(logarithmic, {1, 0, 0}) / least(perspective, {1, 0, 0}), std::sqrt(r), 0.15 * std::sqrt(r));
}

TEST(LogView, KeepsLightRaysOnOneTexel) {
    const Light light = sun({0.4, -1, 0.3});
    const Snapshot scene = slabScene(light);
    const LogView view = fitLog(light, scene, scene.camera, 1);
    const glm::dvec3 ground(1.5, 0.05, -2), above = ground - 3.0 * light.direction;
    EXPECT_NEAR(glm::distance(texelAt(view, ground, 1).value(), texelAt(view, above, 1).value()), 0, 1e-9);
}

TEST(LogView, IsHardlyWarpedInDuellingFrusta) {
    const Light light = sun({0, 0, 1});
    const Snapshot scene = slabScene(light);
    const LogView view = fitLog(light, scene, scene.camera, 1);
    const glm::dvec2 a = texelAt(view, {-2, 0, 0}, 1).value(), b = texelAt(view, {0, 0, 0}, 1).value(),
                     c = texelAt(view, {2, 0, 0}, 1).value();
    EXPECT_NEAR(glm::distance(a, b) / glm::distance(b, c), 1, 0.06);
}

} // namespace
} // namespace shadowbench::techniques
