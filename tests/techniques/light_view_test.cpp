// Fitting of light frusta against closed forms.
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/light_views/visible_part.h"
#include "tests/support/light_views.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

TEST(LightView, HoldsEveryCornerOfTheSceneInTheUnitCube) {
    for (const Light& light : {sun({0.3, -1, 0.2}), Light{LightKind::Point, {3, 25, 4}, {0, -1, 0}, {}, {}}}) {
        const Snapshot scene = slabScene(light);
        const LightView view = fitToScene(light, scene);
        for (const glm::dvec3& corner : boundingCorners(scene)) {
            const glm::dvec3 q = mapped(view, corner);
            EXPECT_LE(glm::length(glm::max(glm::abs(q) - 1.0, glm::dvec3(0))), 1e-9) << q.x << " " << q.y << " " << q.z;
        }
    }
}

TEST(LightView, TouchesTheSceneOnAllFourSides) {
    const Light light = sun({0.3, -1, 0.2});
    const Snapshot scene = slabScene(light);
    const LightView view = fitToScene(light, scene);
    glm::dvec3 low(2), high(-2);
    for (const glm::dvec3& corner : boundingCorners(scene)) {
        low = glm::min(low, mapped(view, corner));
        high = glm::max(high, mapped(view, corner));
    }
    EXPECT_NEAR(low.x, -1, 1e-9);
    EXPECT_NEAR(low.y, -1, 1e-9);
    EXPECT_NEAR(high.x, 1, 1e-9);
    EXPECT_NEAR(high.y, 1, 1e-9);
}

TEST(LightView, DepthGrowsAwayFromTheLightAndIsMetresAlongItsAxis) {
    const Light light{LightKind::Point, {0, 10, 0}, {0, -1, 0}, {}, {}};
    const LightView view = fitToScene(light, slabScene(light));
    EXPECT_LT(mapped(view, {0, 5, 0}).z, mapped(view, {0, 1, 0}).z);
    EXPECT_NEAR(glm::dot(view.depthFromWorld, glm::dvec4(3, 4, -2, 1)), 6, 1e-9); // the axis points straight down
}

TEST(LightView, ARectangularLightsSidesAreTheMapsSides) {
    const Light light{LightKind::Rectangle, {0, 10, 0}, {0, -1, 0}, {2, 0, 1}, {-0.5, 0, 1}};
    const LightView view = fitToScene(light, slabScene(light));
    const glm::dvec3 along = mapped(view, glm::dvec3(0, 1, 0) + light.u) - mapped(view, {0, 1, 0});
    EXPECT_GT(along.x, 0);
    EXPECT_NEAR(along.y, 0, 1e-12);
    EXPECT_NEAR(along.z, 0, 1e-12); // the map's plane is the light's plane
}

TEST(LightView, AFlatLightLooksToTheSideOfTheCamerasTarget) {
    const Light light{LightKind::Disk, {0, 10, 0}, {0, -1, 0}, {2, 0, 0}, {0, 0, 2}};
    Snapshot scene = slabScene(light);
    const glm::dmat4 high = glm::translate(glm::dmat4(1), glm::dvec3(0, 90, 0));
    scene.batches[0].placements.push_back({high, high, 2}); // the middle of the scene is above the light
    const auto axis = [&] { return glm::dvec3(fitToScene(light, scene).depthFromWorld).y; };
    EXPECT_NEAR(axis(), -1, 1e-12);
    const glm::dvec3 rim = light.sample({0.9, 0.5});
    EXPECT_NEAR(fitFromSample(light, rim, scene).depthFromWorld.y, -1, 1e-12);
    scene.camera.target.y = 10 + 1e-9; // in the light's plane but for rounding
    EXPECT_NEAR(axis(), 1, 1e-12);
    scene.camera.target.y = 20;
    EXPECT_NEAR(axis(), 1, 1e-12);
    scene.camera.target.y = -1; // below all that there is
    EXPECT_NEAR(axis(), 1, 1e-12);
}

TEST(LightView, AnAreaLightsViewBeginsAtWhatItsPyramidHolds) {
    // A wall 3 m beside the light rises above its plane: 80° off the axis, the view holds it from 3 / tan 80° on.
    const Light light{LightKind::Rectangle, {0, 2, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    Snapshot scene = slabScene(light);
    const glm::dmat4 beside = glm::translate(glm::dmat4(1), glm::dvec3(3.5, 0, 0));
    scene.batches.push_back({std::make_shared<Mesh>(box({1, 20, 20})), {}, false, {{beside, beside, 2}}});
    EXPECT_NEAR(fitToScene(light, scene).near, 3 / std::tan(glm::radians(80.0)), 1e-5);
    const Light nearer{LightKind::Rectangle, {2.99, 2, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    const LightView held = fitToScene(nearer, scene);
    EXPECT_NEAR(held.near, 0.01 * held.far, 1e-6);
}

TEST(LightView, WarpsAreFittedToWhatTheLightsPyramidHolds) {
    // A lamp in a hall: of the camera's view most is more than 80° off the light's axis.
    const Light lamp{LightKind::Point, {0, 3, -2}, {0, -1, 0}, {}, {}};
    Snapshot scene = slabScene(lamp);
    const glm::dmat4 beside = glm::translate(glm::dmat4(1), glm::dvec3(9.5, 0, 0));
    scene.batches.push_back({std::make_shared<Mesh>(box({1, 20, 20})), {}, false, {{beside, beside, 2}}});
    const LightView whole = fitToScene(lamp, scene), warped = fitLispsm(lamp, scene, scene.camera, 1);
    EXPECT_GE(warped.covered.size(), 8U);
    for (const glm::dvec3& p : warped.covered) EXPECT_TRUE(holds(whole, p)) << p.x << " " << p.y << " " << p.z;
}

TEST(LightView, ALightInsideTheSceneIsHeldAtTheLimitsOfOneMap) {
    const Light light{LightKind::Point, {0, 0.5, 0}, {0, -1, 0}, {}, {}};
    const LightView view = fitToScene(light, slabScene(light));
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) EXPECT_TRUE(std::isfinite(view.clipFromWorld[column][row]));
}

TEST(LightView, VisiblePartOfABoxIsTheBoxWhenTheCameraSeesAllOfIt) {
    Bounds bounds;
    bounds.add({-1, -1, -1});
    bounds.add({1, 1, 1});
    const Camera camera{{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 45, 0.1, 100};
    Bounds seen;
    for (const glm::dvec3& p : visiblePart(bounds, camera, 1)) seen.add(p);
    EXPECT_NEAR(glm::distance(seen.low, bounds.low) + glm::distance(seen.high, bounds.high), 0, 1e-12);
}

TEST(LightView, VisiblePartIsCutAtTheFrustum) {
    Bounds bounds; // a ground from behind the camera to far in front
    bounds.add({-100, -1, -100});
    bounds.add({100, 0, 100});
    const Camera camera{{0, 5, 0}, {0, 5, -10}, {0, 1, 0}, 90, 1, 50};
    Bounds seen;
    for (const glm::dvec3& p : visiblePart(bounds, camera, 1)) {
        seen.add(p);
        EXPECT_LE(std::abs(p.x), -p.z + 1e-9); // 45° to each side
    }
    EXPECT_NEAR(seen.low.z, -50, 1e-9); // the far plane
    EXPECT_NEAR(seen.high.z, -5, 1e-9); // where the 45° lower plane meets the top of the ground
}

TEST(Focused, TouchesWhatTheCameraSeesOnAllFourSides) {
    const Light light = sun({0, -1, 0});
    const Snapshot scene = slabScene(light);
    const LightView view = fitFocused(light, scene, scene.camera, 1);
    // The frustum's 30° lower plane meets the slab's top 1.95 / tan 30° in front of the eye; the far side of the slab is
    // seen.
    const double start = 10 - 1.95 / std::tan(glm::radians(30.0));
    const glm::dvec3 near = mapped(view, {0, 0.05, start}), far = mapped(view, {0, 0.05, -10});
    EXPECT_NEAR(std::abs(near.y - far.y), 2, 1e-9);
    EXPECT_NEAR(std::abs(mapped(view, {-10, 0.05, -10}).x - mapped(view, {10, 0.05, -10}).x), 2, 1e-9);
}

TEST(Focused, IsTheWholeSceneWhereTheCameraSeesNothing) {
    const Light light = sun({0.2, -1, 0.1});
    Snapshot scene = slabScene(light);
    scene.camera.target = {0, 30, 10}; // looks up
    scene.camera.up = {0, 0, -1};
    EXPECT_EQ(fitFocused(light, scene, scene.camera, 1).clipFromWorld, fitToScene(light, scene).clipFromWorld);
}

TEST(Lispsm, NearDistanceIsThePapersForALightPerpendicularToTheView) {
    const double z0 = 1, z1 = 49; // γ = 90°, so d = z1 − z0 and n = z0 + √(z0 z1)
    EXPECT_NEAR(lispsmNear(z1 - z0, z0, z1), z0 + std::sqrt(z0 * z1), 1e-12);
}

TEST(Lispsm, NearDistanceIsThePapersForASlantedDirectionalLight) {
    const double z0 = 2, z1 = 30, gamma = glm::radians(40.0); // depth z1 − z0 over d · sin γ
    EXPECT_NEAR(lispsmNear((z1 - z0) / std::sin(gamma), z0, z1), (z0 + std::sqrt(z0 * z1)) / std::sin(gamma), 1e-12);
}

TEST(Lispsm, DoesNotWarpWhereDepthDoesNotGrow) {
    EXPECT_TRUE(std::isinf(lispsmNear(5, 3, 3)));
    EXPECT_TRUE(std::isinf(lispsmNear(5, -1, 3)));
}

/// Texels per screen distance at view depth `z` on the ground of `slabScene`: |∂map/∂z| · z up to a constant.
double samplingOverNeed(const LightView& view, double z) {
    const glm::dvec3 p(0, 0.05, 10 - z);
    const double step = 1e-5;
    return glm::length(glm::dvec2(mapped(view, p + glm::dvec3(0, 0, -step)) - mapped(view, p))) / step * z;
}

TEST(Lispsm, SpreadsTheErrorEvenlyFromNearToFar) {
    const Light overhead = sun({0, -1, 0});
    const Snapshot scene = slabScene(overhead);
    const LightView warped = fitLispsm(overhead, scene, scene.camera, 1);
    const LightView uniform = fitToScene(overhead, scene);
    // The body starts where the frustum's 30° lower plane meets the slab's top and ends at its far side.
    const double z0 = 1.95 / std::tan(glm::radians(30.0)), z1 = 20;
    // n_opt makes the error equal at both ends; a fifth is left for the body's corners, which lie a little off these depths.
    EXPECT_NEAR(samplingOverNeed(warped, z0 * 1.001) / samplingOverNeed(warped, z1 * 0.999), 1, 0.2);
    EXPECT_NEAR(samplingOverNeed(uniform, z1 * 0.999) / samplingOverNeed(uniform, z0 * 1.001), z1 / z0, 0.1 * z1 / z0);
    EXPECT_GT(samplingOverNeed(warped, z0 * 1.001), 2 * samplingOverNeed(uniform, z0 * 1.001));
}

TEST(Lispsm, KeepsLightRaysOnOneTexel) {
    const Light light = sun({0.4, -1, 0.3});
    const Snapshot scene = slabScene(light);
    const LightView view = fitLispsm(light, scene, scene.camera, 1);
    const glm::dvec3 ground(1.5, 0.05, -2);
    const glm::dvec3 above = ground - 3.0 * light.direction;
    EXPECT_NEAR(glm::distance(glm::dvec2(mapped(view, ground)), glm::dvec2(mapped(view, above))), 0, 1e-9);
    EXPECT_LT(mapped(view, above).z, mapped(view, ground).z);
}

TEST(Lispsm, HoldsEveryVisiblePointOfTheScene) {
    // A wide ground under a light that is not above its middle, with something tall: the bounding box reaches beyond the
    // near plane.
    const Light light{LightKind::Point, {0.2, 8.1, 0.3}, {0, -1, 0}, {}, {}};
    Snapshot scene = slabScene(light);
    scene.camera = {{3.1, 4.2, 7.3}, {0, 0.6, 0}, {0, 1, 0}, 40, 0.1, 60};
    const glm::dmat4 up = glm::translate(glm::dmat4(1), glm::dvec3(-6, 1.2, 5));
    scene.batches.push_back({std::make_shared<Mesh>(box({1, 2.3, 1})), {}, false, {{up, up, 2}}});
    const glm::dvec3 low = scene.bounds().low, high = scene.bounds().high;
    const LightView view = fitLispsm(light, scene, scene.camera, 1);
    std::size_t seen = 0;
    for (int i = 0; i < 20 * 20 * 20; ++i) {
        const glm::dvec3 share = glm::dvec3(i % 20, i / 20 % 20, i / 400) / 19.0;
        const glm::dvec3 p = low + share * (high - low);
        const glm::dvec3 pixel = scene.camera.project(p, {100, 100});
        if (pixel.z < 0.1 || pixel.x < 0 || pixel.x > 100 || pixel.y < 0 || pixel.y > 100) continue;
        if (glm::dot(view.depthFromWorld, glm::dvec4(p, 1)) < view.near) continue;
        ++seen;
        const glm::dvec3 q = mapped(view, p);
        EXPECT_LE(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}), 1 + 1e-9) << p.x << " " << p.y << " " << p.z;
    }
    EXPECT_GT(seen, 1000U);
}

TEST(Lispsm, IsUnwarpedInDuellingFrusta) {
    // The light shines against the view direction, parallel to it.
    const Light light = sun({0, 0, 1});
    const Snapshot scene = slabScene(light);
    const LightView view = fitLispsm(light, scene, scene.camera, 1);
    const glm::dvec3 a = mapped(view, {-2, 0, 0}), b = mapped(view, {0, 0, 0}), c = mapped(view, {2, 0, 0});
    EXPECT_NEAR(glm::distance(a, b), glm::distance(b, c), 1e-6); // equal steps stay equal: no perspective
}

TEST(Lispsm, IsTheFocusedMapInDuellingFrusta) {
    for (const Light& light : {sun({0.02, 0, 1}), Light{LightKind::Point, {1, 2, -30}, {0, 0, 1}, {}, {}}}) {
        Snapshot scene = slabScene(light);
        const glm::dmat4 up = glm::translate(glm::dmat4(1), glm::dvec3(-6, 1.2, -5));
        scene.batches.push_back({std::make_shared<Mesh>(box({1, 2.3, 1})), {}, false, {{up, up, 2}}});
        scene.camera.eye = {1, 2, 10}; // on the point light's line of sight
        scene.camera.target = {1, 2, -10};
        if (light.kind == LightKind::Directional) scene.camera.target = scene.camera.eye - light.direction;
        EXPECT_EQ(fitLispsm(light, scene, scene.camera, 1).clipFromWorld,
                  fitFocused(light, scene, scene.camera, 1).clipFromWorld);
    }
}

TEST(Lispsm, RowsOfTheMapLieAcrossTheViewAlsoWhereTheSceneIsOblong) {
    const Light light = sun({0.4, -1, 0.3});
    Snapshot scene = slabScene(light);
    scene.batches.front().mesh = std::make_shared<Mesh>(box({60, 0.1, 20}));
    const LightView view = fitLispsm(light, scene, scene.camera, 1);
    const glm::dvec3 p(1.5, 0.05, -2);
    const glm::dvec3 across = glm::normalize(glm::cross(light.direction, scene.camera.basis().forward));
    EXPECT_NEAR(mapped(view, p + across).y, mapped(view, p).y, 1e-9);
    EXPECT_GT(std::abs(mapped(view, p + across).x - mapped(view, p).x), 0.01);
}

// Light and camera in one plane, which cuts scene and frustum in two like halves.
TEST(Lispsm, OfASceneThatIsAlikeOnBothSidesIsAlikeOnBothSides) {
    for (const double height : {3.0, 9.0, 27.0}) {
        Snapshot scene = slabScene({LightKind::Point, {0, height, -30}, {0, -1, 0}, {}, {}});
        scene.camera.target = {0, 0.5, -10};
        const LightView view = fitLispsm(scene.light, scene, scene.camera, 1);
        for (const glm::dvec3& p : {glm::dvec3(1.5, 0.05, 2), glm::dvec3(4, 0.05, -7)}) {
            const glm::dvec3 right = mapped(view, p), left = mapped(view, p * glm::dvec3(-1, 1, 1));
            EXPECT_NEAR(right.x, -left.x, 1e-6) << height;
            EXPECT_NEAR(right.y, left.y, 1e-6) << height;
        }
    }
}

// The near plane cuts through the scene, behind the light: the corners of the cut are equally near to the eye, up to
// rounding.
TEST(Lispsm, RoundingDoesNotChooseTheMap) {
    Snapshot scene = slabScene({LightKind::Point, {-0.4, 2, 0.3}, {0, -1, 0}, {}, {}});
    scene.batches.front().mesh = std::make_shared<Mesh>(box({10, 5, 10}));
    scene.camera = {{0.77, 13.31, 7.13}, {-0.07, 0.41, 0.03}, {0, 1, 0}, 43, 13, 40};
    const glm::dvec3 p(0.3, 0.1, 0.5);
    const glm::dvec3 before = mapped(fitLispsm(scene.light, scene, scene.camera, 1), p);
    for (int i = 0; i < 27; ++i) {
        Camera moved = scene.camera;
        moved.eye += 1e-14 * glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        EXPECT_LT(glm::distance(mapped(fitLispsm(scene.light, scene, moved, 1), p), before), 1e-6) << i;
    }
}

TEST(Jitter, CoversTheSamePointsAfterAnyTurnAndShift) {
    const Light light{LightKind::Point, {3, 25, 4}, {0, -1, 0}, {}, {}};
    const LightView view = fitToScene(light, slabScene(light));
    for (int i = 0; i < 16; ++i) {
        const LightView turned = jittered(view, 0.4 * i, {0.5, -0.5}, 64);
        for (const glm::dvec3& p : view.covered) {
            const glm::dvec3 q = mapped(turned, p);
            EXPECT_LE(std::max(std::abs(q.x), std::abs(q.y)), 1 + 1e-9);
        }
    }
}

TEST(Jitter, LeavesDepthAlone) {
    const Light light{LightKind::Point, {3, 25, 4}, {0, -1, 0}, {}, {}};
    const LightView view = fitToScene(light, slabScene(light));
    EXPECT_NEAR(mapped(jittered(view, 1.0, {0.2, 0.1}, 64), {1, 0, 2}).z, mapped(view, {1, 0, 2}).z, 1e-12);
}

} // namespace
} // namespace shadowbench::techniques
