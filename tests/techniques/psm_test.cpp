// Perspective shadow maps against closed forms.
#include "scene/meshes/primitives.h"
#include "techniques/maps/sm-psm/psm_view.h"
#include "tests/support/light_views.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

Light lamp(const glm::dvec3& at) { return {LightKind::Point, at, {0, -1, 0}, {}, {}}; }

/// A ground of 200 m, its top at y = 0, under a camera 2 m above it that looks along −z.
Snapshot groundScene(const Light& light) {
    Snapshot snapshot;
    snapshot.camera = {{0, 2, 0}, {0, 2, -10}, {0, 1, 0}, 60, 1, 80};
    snapshot.light = light;
    const glm::dmat4 place = glm::dmat4(1);
    Mesh ground = box({200, 0.2, 200});
    for (glm::vec3& p : ground.positions) p.y -= 0.1F;
    snapshot.batches.push_back({std::make_shared<Mesh>(std::move(ground)), {}, false, {{place, place, 1}}});
    return snapshot;
}

TEST(Psm, NearToTwiceNearTakesHalfOfTheMapOfTheWholeFrustum) { // course: z → 1 − 1/z
    const Light overhead = sun({0, -1, 0});
    Snapshot scene = groundScene(overhead);
    const LightView view = fitPsm(overhead, scene, scene.camera, 1, {0, BehindEye::NegativeNear, PsmBody::Cube});
    const double n = scene.camera.near, f = scene.camera.far;
    const auto along = [&](double depth) { return mapped(view, {0, 2, -depth}).y; };
    EXPECT_NEAR((along(2 * n) - along(n)) / (along(f) - along(n)), 0.5 / (1 - n / f), 1e-3);
}

TEST(Psm, TheShareOfNearDepthFallsAsTheVirtualCameraMovesBack) {
    const Camera camera = groundScene(sun({0, -1, 0})).camera;
    const double n = camera.near, f = camera.far;
    for (const double shift : {0.0, 1.0, 20.0}) { // depth after the perspective: (1/N − 1/z) / (1/N − 1/F)
        const double expected = (1 / (n + shift) - 1 / (2 * n + shift)) / (1 / (n + shift) - 1 / (f + shift));
        EXPECT_NEAR(nearDepthShare(camera, movedBack(camera, shift), 1), expected, 1e-9) << shift;
    }
    EXPECT_NEAR(nearDepthShare(camera, camera, 1), 0.5 * f / (f - n), 1e-9); // the course's half
}

TEST(Psm, ALightCloseToThePostPerspectiveBodyStillHasItAllInItsMap) { // course, "Deep Light Sources"
    const Light facing = lamp({3, 1.5, -130}); // low behind the ground's end, a hundredth beyond the body
    const Snapshot scene = groundScene(facing);
    const LightView view = fitPsm(facing, scene, scene.camera, 1, {});
    ASSERT_FALSE(view.covered.empty());
    for (const glm::dvec3& corner : view.covered) {
        const glm::dvec3 at = mapped(view, corner);
        EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 1 + 1e-6) << corner.x << " " << corner.y << " " << corner.z;
    }
}

TEST(Psm, ALightParallelToTheImagePlaneGivesEveryPixelEqualWidth) {
    for (const Light& light : {sun({0, -1, 0}), sun({0.5, -1, 0})}) {
        const Snapshot scene = groundScene(light);
        const LightView view = fitPsm(light, scene, scene.camera, 1, {});
        // A pixel's width on the ground grows with depth; across the view it is the same share of the map everywhere.
        const auto width = [&](double depth) {
            return glm::distance(glm::dvec2(mapped(view, {1e-3 * depth, 0, -depth})),
                                 glm::dvec2(mapped(view, {0, 0, -depth})));
        };
        EXPECT_NEAR(width(5) / width(60), 1, 1e-3); // the light is at a distance of a million, not infinity
    }
}

TEST(Psm, KeepsLightRaysOnOneTexelWithDepthGrowingAwayFromTheLight) {
    const std::vector<Light> lights{
        lamp({3, 15, -40}),   // before the viewer
        lamp({3, 15, 20}),    // behind the viewer: a sink of rays after the perspective
        lamp({3, 15, 0}),     // in the camera's plane: parallel rays
        sun({0.3, -1, 0.7}),  // towards the viewer
        sun({0.3, -1, -0.7}), // from behind
        sun({0.3, -1, 0}),
    };
    for (const Light& light : lights) {
        const Snapshot scene = groundScene(light);
        const LightView view = fitPsm(light, scene, scene.camera, 1, {});
        const glm::dvec3 ground(1.5, 0, -12);
        const glm::dvec4 at = light.homogeneous();
        glm::dvec3 previous = mapped(view, ground);
        EXPECT_LE(std::max(std::abs(previous.x), std::abs(previous.y)), 1);
        for (const double share :
             {0.1, 0.3, 0.5, 0.7, 0.9, 0.98}) { // towards the light, past the eye's plane where it is behind
            const glm::dvec3 p = ground + share * (at.w > 0 ? glm::dvec3(at) - ground : 30.0 * glm::dvec3(at));
            const glm::dvec3 q = mapped(view, p);
            EXPECT_NEAR(glm::distance(glm::dvec2(q), glm::dvec2(previous)), 0, 1e-3) << light.centre.z;
            EXPECT_LT(q.z, previous.z) << light.centre.z << " " << share;
            EXPECT_GT((view.clipFromWorld * glm::dvec4(p, 1)).w, 0);
            previous = q;
        }
    }
}

TEST(Psm, HoldsEveryVisiblePointWhereTheLightIsJustBehindThePostPerspectiveScene) {
    // The sun behind the viewer shines into the picture: its sink is at (0.5, −0.4, 1.05), right behind the unit cube.
    const Light light = sun({0.13, -0.47, -0.87});
    Snapshot scene = groundScene(light);
    scene.camera = {{0.3, 2.1, 3.4}, {-0.2, 0.3, -2.1}, {0, 1, 0}, 48, 0.3, 15};
    const LightView view = fitPsm(light, scene, scene.camera, 1, {});
    for (int i = 0; i < 400; ++i) {
        const glm::ivec2 cell(i % 20, i / 20);
        const glm::dvec2 pixel = 5.0 * glm::dvec2(cell) + 2.5;
        const glm::dvec3 ray = scene.camera.ray(pixel, {100, 100}), p = scene.camera.eye - scene.camera.eye.y / ray.y * ray;
        if (ray.y >= 0 || scene.camera.project(p, {100, 100}).z > scene.camera.far) continue;
        const glm::dvec3 q = mapped(view, p);
        EXPECT_LE(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}), 1 + 1e-9) << p.x << " " << p.z;
        EXPECT_GT((view.clipFromWorld * glm::dvec4(p, 1)).w, 0);
    }
}

TEST(Psm, AVirtualCameraHoldsTheOldFrustumAndItsNearPlane) {
    const Camera camera{{1, 2, 3}, {1, 2, -10}, {0, 1, 0}, 60, 1, 50};
    const Camera moved = movedBack(camera, 20);
    EXPECT_NEAR(moved.eye.z, 23, 1e-12);
    EXPECT_NEAR(moved.eye.z - moved.near, camera.eye.z - camera.near, 1e-12);
    const auto halfHeight = [](const Camera& c, double z) { return (c.eye.z - z) * std::tan(glm::radians(0.5 * c.fovy)); };
    EXPECT_NEAR(halfHeight(moved, 3 - 50), halfHeight(camera, 3 - 50), 1e-9);
    EXPECT_GT(halfHeight(moved, 2), halfHeight(camera, 2));
}

TEST(Psm, TendsToAUniformMapAsTheVirtualCameraMovesBack) {
    const Light overhead = sun({0, -1, 0});
    const Snapshot scene = groundScene(overhead);
    const LightView far = fitPsm(overhead, scene, scene.camera, 1, {1e4, BehindEye::NegativeNear, PsmBody::Box});
    const glm::dvec3 a = mapped(far, {0, 0, -10}), b = mapped(far, {0, 0, -30}), c = mapped(far, {0, 0, -50});
    EXPECT_NEAR(glm::distance(a, b) / glm::distance(b, c), 1, 0.02);
}

TEST(Psm, MovesBackUntilNothingIsBehindTheEye) {
    const Light light = sun({0.3, -1, -0.7});
    const Snapshot scene = groundScene(light);
    const LightView lost = fitPsm(light, scene, scene.camera, 1, {0, BehindEye::Lost, PsmBody::Box});
    EXPECT_LT(glm::dot(lost.casterPlane, glm::dvec4(0, 1, 5, 1)), 0);
    EXPECT_GT(glm::dot(lost.casterPlane, glm::dvec4(0, 1, -5, 1)), 0);
    const LightView back = fitPsm(light, scene, scene.camera, 1, {0, BehindEye::MoveBack, PsmBody::Box});
    EXPECT_GT(glm::dot(back.casterPlane, glm::dvec4(0, 1, 99, 1)), 0);
    // The ground ends 100 m behind the eye: from there the perspective is nearly gone.
    const double first = glm::distance(mapped(back, {0, 0, -10}), mapped(back, {0, 0, -20}));
    const double last = glm::distance(mapped(back, {0, 0, -60}), mapped(back, {0, 0, -70}));
    EXPECT_LT(first / last, 2.5); // (160 · 170) / (110 · 120) = 2.1 after moving back, (60 · 70) / (10 · 20) = 21 before
}

} // namespace
} // namespace shadowbench::techniques
