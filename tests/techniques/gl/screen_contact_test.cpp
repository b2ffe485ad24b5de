// Screen-space contact shadows: how far they reach, what they take for blocked, and what they cannot see.
#include "tests/support/filtered_scenes.h"
#include "tests/support/rows_over_frames.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

const std::string noMap =
    "screen-contact:units=10000000,"; // a bias of more than half the depth range: the map shadows nothing

/// A wall 1 m high whose foot is the line x = 0, on the side of smaller x, under a light that is `elevation` degrees high on
/// that side; seen from the shadow's side.
Scene wallScene(double elevation, double targetX) {
    Scene scene = groundScene(160);
    const double up = glm::radians(elevation);
    scene.light = {LightKind::Directional, {}, {std::cos(up), -std::sin(up), 0}, {}, {}};
    scene.camera = {{3 + targetX, 2.5, 0.1}, {targetX, 0, 0}, {0, 1, 0}, 16, 0.5, 40};
    scene.objects.push_back(object(box({0.5, 1.2, 12}), {-0.25, 0.4, 0}));
    return scene;
}

/// Greatest x of shadowed ground, 0 without any.
double shadowReaches(const Stage& stage, const Image<float>& image) {
    double most = 0;
    for (const GroundPoint& point : groundPoints(stage, image))
        if (point.visibility < 0.5 && point.at.x > 0) most = std::max(most, point.at.x);
    return most;
}

TEST(ScreenContact, ReachesAsFarAsItsRaysDo) {
    const Scene scene = wallScene(40, 0.2);
    Stage stage(scene);
    stage.show(0);
    for (const double length : {0.15, 0.3, 0.45}) {
        const Image<float> image = imageAfter(stage, noMap + "steps=64,length=" + std::to_string(length), 1);
        EXPECT_NEAR(shadowReaches(stage, image), length * std::cos(glm::radians(40.0)), 0.02) << length;
    }
}

TEST(ScreenContact, ShadowsAllWithinItsLengthThatTheImageShowsTheCasterOf) {
    const Scene scene = wallScene(40, 0.2);
    Stage stage(scene);
    stage.show(0);
    for (const GroundPoint& point : groundPoints(stage, imageAfter(stage, noMap + "steps=64", 1))) {
        if (point.at.x > 0.02 && point.at.x < 0.2) { // 0.23 m are within 0.3 m of ray
            EXPECT_EQ(point.visibility, 0) << point.at.x;
        }
        if (point.at.x > 0.25) {
            EXPECT_EQ(point.visibility, 1) << point.at.x;
        }
    }
}

TEST(ScreenContact, DoesNotSeeBesideTheImage) { // the wall's foot lies just outside
    const Scene scene = wallScene(40, 1.1);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(shadowReaches(stage, imageAfter(stage, noMap + "steps=64", 1)), 0);
}

TEST(ScreenContact, NoPlaneShadowsItself) { // however it is seen and lit
    Scene scene = groundScene(96);
    for (const double eye : {0.3, 2.0, 7.0})
        for (const glm::dvec3& direction :
             {glm::dvec3(-1, -0.03, -0.4), glm::dvec3(0.2, -1, 0.3), glm::dvec3(0.1, -0.05, 1)}) {
            scene.camera = {{2.1, eye, 4.3}, {0.1, 0, 0.2}, {0, 1, 0}, 45, 0.1, 40};
            scene.light = {LightKind::Directional, {}, glm::normalize(direction), {}, {}};
            Stage stage(scene);
            stage.show(0);
            const auto points = groundPoints(stage, imageAfter(stage, noMap + "steps=64", 1));
            EXPECT_GT(points.size(), 500U);
            for (const GroundPoint& point : points) ASSERT_EQ(point.visibility, 1) << eye << " " << point.at.x;
        }
}

TEST(ScreenContact, TakesAWireForAsThickAsEverything) { // what engines' users see
    Scene scene = wallScene(40, 0.2);
    scene.objects[1] = object(box({0.01, 0.01, 12}), {-0.15, 0.155, 0}); // its own shadow is 1.6 cm wide, at x = 0.03
    Stage stage(scene);
    stage.show(0);
    const auto shadowed = [&](const std::string& variant) {
        double count = 0;
        for (const GroundPoint& point : groundPoints(stage, imageAfter(stage, variant, 1))) count += 1 - point.visibility;
        return count;
    };
    const double thick = shadowed(noMap + "steps=64,thickness=0.1"), thin = shadowed(noMap + "steps=64,thickness=0.01");
    EXPECT_GT(thin, 50);
    EXPECT_GT(thick, 3 * thin);
}

} // namespace
} // namespace shadowbench
