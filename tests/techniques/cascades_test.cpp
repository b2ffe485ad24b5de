// Partition of the view frustum and of an atlas, against closed forms.
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/maps/depth_atlas.h"
#include "tests/support/light_views.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace shadowbench::techniques {
namespace {

TEST(PracticalSplits, AreGeometricalAtLambdaOneAndEvenAtZero) {
    const auto geometrical = practicalSplits(1, 16, 4, 1), even = practicalSplits(1, 17, 4, 0);
    ASSERT_EQ(geometrical.size(), 5U);
    for (int i = 0; i <= 4; ++i) {
        EXPECT_NEAR(geometrical[static_cast<std::size_t>(i)], std::pow(2, i), 1e-12);
        EXPECT_NEAR(even[static_cast<std::size_t>(i)], 1 + 4 * i, 1e-12);
    }
}

TEST(PracticalSplits, AreTheMeanOfBothAtOneHalf) {
    const auto mixed = practicalSplits(2, 50, 2, 0.5);
    EXPECT_EQ(mixed, (std::vector<double>{2, 0.5 * (10 + 26), 50})); // √(2·50) and the middle
}

TEST(VisibleDepths, AreThoseOfTheBoxWithinTheFrustum) {
    Bounds box; // a ground from behind the camera to far in front
    box.add({-100, -1, -100});
    box.add({100, 0, 100});
    const Camera camera{{0, 5, 0}, {0, 5, -10}, {0, 1, 0}, 90, 1, 50};
    const DepthRange depths = visibleDepths(box, camera, 1);
    EXPECT_NEAR(depths.near, 5, 1e-9); // where the 45° lower plane meets the ground
    EXPECT_NEAR(depths.far, 50, 1e-9); // the far plane
}

TEST(SliceRanges, ReachBackOverWhatIsBlendedOfTheSliceBefore) {
    const auto ranges = sliceRanges({1, 3, 11, 20}, 0.25);
    ASSERT_EQ(ranges.size(), 3U);
    EXPECT_EQ(std::pair(ranges[0].near, ranges[0].far), std::pair(1.0, 3.0));
    EXPECT_EQ(std::pair(ranges[1].near, ranges[1].far), std::pair(2.5, 11.0));
    EXPECT_EQ(std::pair(ranges[2].near, ranges[2].far), std::pair(9.0, 20.0));
}

std::vector<glm::dvec3> frustumCorners(const Camera& camera, double aspect) {
    const Camera::Basis basis = camera.basis();
    const double up = std::tan(glm::radians(camera.fovy) / 2);
    std::vector<glm::dvec3> corners;
    for (const double depth : {camera.near, camera.far})
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                corners.push_back(camera.eye + depth * (basis.forward + x * aspect * up * basis.right + y * up * basis.up));
    return corners;
}

TEST(FrustumSphere, IsTheSmallestThatHoldsAllCorners) {
    for (const double fovy : {20.0, 45.0, 90.0, 130.0}) { // from narrow to wider than the far plane's ball
        const Camera camera{{1, 2, 3}, {-2, 0.5, -7}, {0, 1, 0}, fovy, 2, 9};
        const Sphere ball = frustumSphere(camera, 1.5);
        double nearest = 1e9, farthest = 0, farPlane = 0;
        for (const glm::dvec3& corner : frustumCorners(camera, 1.5)) {
            const double distance = glm::distance(corner, ball.centre);
            nearest = std::min(nearest, distance);
            farthest = std::max(farthest, distance);
            farPlane = std::max(farPlane, glm::distance(corner, camera.eye + 9.0 * camera.basis().forward));
        }
        EXPECT_NEAR(farthest, ball.radius, 1e-9) << fovy;
        if (farPlane > ball.radius + 1e-9) {
            EXPECT_NEAR(nearest, ball.radius, 1e-9) << fovy; // all eight lie on it
        }
    }
}

/// A camera that stands and looks somewhere, with the same planes and angle of view each time.
Camera cameraOnItsWay(int step) {
    const double t = 0.37 * step;
    return {{3 * std::sin(t), 1.7 + 0.2 * std::cos(3 * t), -1.13 * t},
            {3 * std::sin(t) + std::sin(5 * t), 1.6 - 0.4 * std::sin(t), -1.13 * t - std::cos(5 * t)},
            {0, 1, 0},
            50,
            2,
            9};
}

TEST(StableSlice, ItsTexelsStayWhereTheyAreWhileTheCameraMovesAndTurns) {
    constexpr int texels = 512;
    for (const glm::dvec3& direction : {glm::dvec3(0.4, -1, 0.3), glm::dvec3(0, -1, 0), glm::dvec3(-0.9, -0.2, 0.1)}) {
        const Snapshot scene = slabScene(sun(direction));
        const LightView first = fitStable(scene.light, scene, cameraOnItsWay(0), 1.5, texels);
        for (int step = 1; step < 200; ++step) {
            const LightView view = fitStable(scene.light, scene, cameraOnItsWay(step), 1.5, texels);
            for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(3.1, -0.2, -7.7)}) {
                const glm::dvec2 moved = 0.5 * texels * glm::dvec2(mapped(view, p) - mapped(first, p));
                EXPECT_NEAR(moved.x, std::round(moved.x), 1e-6) << step;
                EXPECT_NEAR(moved.y, std::round(moved.y), 1e-6) << step;
            }
        }
    }
}

TEST(StableSlice, ItsTexelsStayWhereTheyAreWhileTheSceneGrows) {
    Snapshot scene = slabScene(sun({0.4, -1, 0.3}));
    const LightView before = fitStable(scene.light, scene, cameraOnItsWay(0), 1, 512);
    scene.batches[0].placements[0].world[3] = glm::dvec4(0.731, 0.119, -0.313, 1);
    const LightView after = fitStable(scene.light, scene, cameraOnItsWay(0), 1, 512);
    const glm::dvec2 moved = 256.0 * glm::dvec2(mapped(after, {1, 0, 2}) - mapped(before, {1, 0, 2}));
    EXPECT_NEAR(moved.x, 0, 1e-6);
    EXPECT_NEAR(moved.y, 0, 1e-6);
}

TEST(StableSlice, HoldsTheWholeSlice) {
    const Snapshot scene = slabScene(sun({0.4, -1, 0.3}));
    for (int step = 0; step < 200; ++step) {
        const Camera camera = cameraOnItsWay(step);
        const LightView view = fitStable(scene.light, scene, camera, 1.5, 64);
        for (const glm::dvec3& corner : frustumCorners(camera, 1.5)) {
            EXPECT_LE(std::abs(mapped(view, corner).x), 1 + 1e-9) << step;
            EXPECT_LE(std::abs(mapped(view, corner).y), 1 + 1e-9) << step;
        }
    }
}

TEST(Tiles, AreSquareAndShareAtMostTheTexelsOfOneMap) {
    for (int count = 1; count <= 8; ++count) {
        const std::vector<Tile> tiles = squareTiles(1024, count);
        ASSERT_EQ(tiles.size(), static_cast<std::size_t>(count));
        int texels = 0;
        for (const Tile& tile : tiles) {
            EXPECT_EQ(tile.size.x, tile.size.y);
            texels += tile.size.x * tile.size.y;
        }
        EXPECT_LE(texels, 1024 * 1024);
        EXPECT_GE(texels, 0.99 * 1024 * 1024) << count; // what whole texels leave over
    }
    EXPECT_EQ(squareTiles(1024, 4)[3], (Tile{{512, 512}, {512, 512}}));
}

} // namespace
} // namespace shadowbench::techniques
