// Trapezoidal shadow maps against closed forms.
#include "techniques/maps/sm-tsm/tsm_view.h"
#include "tests/support/light_views.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

TEST(Tsm, CentreOfProjectionIsThePapers) { // η = λ δ (1 + ξ) / (λ − 2 δ − λ ξ) with ξ = −0.6
    const double height = 7, focus = 2.5, xi = -0.6;
    EXPECT_NEAR(tsmCentre(height, focus, 0.8), height * focus * (1 + xi) / (height - 2 * focus - height * xi), 1e-12);
    EXPECT_TRUE(std::isinf(tsmCentre(1, 0.8, 0.8)));
}

TEST(Tsm, TheFocusRegionTakesFourFifthsOfTheMap) {
    const Light overhead = sun({0, -1, 0});
    const Snapshot scene = slabScene(overhead);
    const LightView view = fitTsm(overhead, scene, scene.camera, 1, 0.3);
    // Visible depths: from where the 30° lower plane meets the slab's lower side to its far end.
    const double near = 1.95 / std::tan(glm::radians(30.0)), far = 20;
    EXPECT_NEAR(mapped(view, {0, 0, 10 - (near + 0.3 * (far - near))}).y, 2 * 0.8 - 1, 0.01);
    EXPECT_NEAR(mapped(view, {0, 0.05, -10}).y, 1, 1e-9);
}

TEST(Tsm, KeepsLightRaysOnOneTexel) {
    const Light light = sun({0.4, -1, 0.3});
    const Snapshot scene = slabScene(light);
    const LightView view = fitTsm(light, scene, scene.camera, 1, 0.3);
    const glm::dvec3 ground(1.5, 0.05, -2), above = ground - 3.0 * light.direction;
    EXPECT_NEAR(glm::distance(glm::dvec2(mapped(view, ground)), glm::dvec2(mapped(view, above))), 0, 1e-9);
    EXPECT_LT(mapped(view, above).z, mapped(view, ground).z);
}

TEST(Tsm, IsUnwarpedInDuellingFrusta) {
    const Light light = sun({0, 0, 1});
    const Snapshot scene = slabScene(light);
    const LightView view = fitTsm(light, scene, scene.camera, 1, 0.3);
    const glm::dvec3 a = mapped(view, {-2, 0, 0}), b = mapped(view, {0, 0, 0}), c = mapped(view, {2, 0, 0});
    EXPECT_NEAR(glm::distance(a, b), glm::distance(b, c), 1e-6);
}

} // namespace
} // namespace shadowbench::techniques
