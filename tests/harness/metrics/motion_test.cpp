// How far a scene moves from frame to frame, and flicker by that.
#include "harness/metrics/frames.h"
#include "harness/metrics/scores.h"
#include "scene/mesh.h"
#include "tests/support/metrics_images.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::metrics {
namespace {

using namespace test;

constexpr int size = 16;
constexpr double distance = 5; // metres from the eye to the wall, at right angles

/// A wall in front of a camera with a narrow view, seen from `before` in the frame before.
struct Wall {
    Snapshot now;
    Light lightBefore;
    groundtruth::Reference truth = truthOf(size, size, [](glm::dvec2) { return 1.0; });
    Image<glm::vec2> warp{size, size};

    Wall() {
        now.camera.fovy = 4;
        now.light.kind = LightKind::Point;
        now.light.centre = {0, 0, distance};
        now.previousCamera = now.camera;
        lightBefore = now.light;
    }
    [[nodiscard]] double motion() {
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const glm::dvec3 point = now.camera.eye + distance * now.camera.ray({x + 0.5, y + 0.5}, {size, size});
                truth.position(x, y) = point;
                warp(x, y) = glm::vec2(now.previousCamera.project(point, {size, size}));
            }
        return metrics::motion(now, lightBefore, truth, warp);
    }
};

constexpr double narrow = 0.002; // cos 2°, and twice as much for a path across it

TEST(Motion, OfACameraThatTurnsIsItsAngle) {
    Wall wall;
    wall.now.previousCamera.target = {std::tan(glm::radians(1.0)), 0, -1};
    EXPECT_NEAR(wall.motion(), 1, narrow);
}

TEST(Motion, OfACameraThatShiftsIsTheAngleAtWhichTheShiftIsSeen) {
    Wall wall;
    wall.now.previousCamera.eye = {0.1, 0, 0};
    wall.now.previousCamera.target = {0.1, 0, -1};
    const double angle = glm::degrees(std::atan(0.1 / distance));
    EXPECT_NEAR(wall.motion(), angle, narrow * angle);
}

TEST(Motion, OfALightIsTheAngleThatItTurnsSeenFromTheMiddleOfTheReceivers) {
    Wall wall;
    wall.lightBefore.centre = {2 * distance * std::tan(glm::radians(3.0)), 0, distance}; // the wall is as far behind
    EXPECT_NEAR(wall.motion(), 3, 1e-3);
    wall.now.light.kind = wall.lightBefore.kind = LightKind::Directional;
    wall.now.light.direction = {0, 0, -1};
    wall.lightBefore.direction = {std::sin(glm::radians(2.0)), 0, -std::cos(glm::radians(2.0))};
    EXPECT_NEAR(wall.motion(), 2, 1e-3);
}

TEST(Motion, OfCastersIsTheLargestAngleOfACornerOfTheirBounds) {
    const auto mesh = std::make_shared<Mesh>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    Wall wall;
    const auto shifted = [](double x) { return glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 0)); };
    wall.now.batches.push_back({mesh, {1, 1, 1}, true, {{shifted(0), shifted(0), 1}, {shifted(-1), shifted(0), 2}}});
    EXPECT_NEAR(wall.motion(), glm::degrees(std::atan(1 / distance)), 1e-3) << "the corner in the axis moves by a metre";
    wall.now.batches.back().placements = {{shifted(1), shifted(0), 1}};
    EXPECT_NEAR(wall.motion(), glm::degrees(std::atan(1 / distance)), 1e-3) << "from the axis";
    wall.now.batches.back().placements = {{shifted(0), shifted(1), 1}};
    EXPECT_NEAR(wall.motion(), glm::degrees(std::atan(1 / distance)), 1e-3) << "to the axis";
}

TEST(Motion, OfACasterThatDeformsIsThatOfItsBounds) {
    const auto meshTo = [](float x) { return std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {x, 0, 0}, {0, 1, 0}}, {}}); };
    Wall wall;
    wall.now.batches.push_back({meshTo(2), {1, 1, 1}, true, {{glm::dmat4(1), glm::dmat4(1), 1}}, meshTo(1)});
    EXPECT_NEAR(wall.motion(), glm::degrees(std::atan(2 / distance) - std::atan(1 / distance)), 1e-3);
}

TEST(Motion, OfNothingIsNone) {
    Wall wall;
    EXPECT_LT(wall.motion(), 1e-4) << "but for floats";
    for (glm::vec2& position : wall.warp) position = glm::vec2(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(metrics::motion(wall.now, wall.lightBefore, wall.truth, wall.warp), 0);
}

/// The flicker of an image over frames in which everything rests on the screen but the image's error: `error(degrees,
/// frame)` is added to V* after so many degrees of motion.
template <class Error>
Flicker flickerOf(double degreesPerFrame, const Error& error) {
    const auto truth = truthOf(size, size, [](glm::dvec2) { return 0.5; });
    const Mask mask = everything(truth);
    Image<glm::vec2> still(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) still(x, y) = glm::vec2(x, y) + 0.5F;
    std::vector<Image<float>> images;
    for (int frame = 0; frame < 9; ++frame)
        images.push_back(imageOf(size, size, [&](glm::dvec2 p) { return 0.5 + error(p, degreesPerFrame * frame, frame); }));
    MovingFrames frames;
    for (std::size_t i = 1; i < images.size(); ++i)
        frames.pairs.push_back({{images[i], truth, mask}, {images[i - 1], truth, mask}, still});
    frames.motion = 8 * degreesPerFrame;
    return *flicker(frames);
}

// An error 0.1 sin(x + 0.5 d) after d degrees changes by 0.05 |cos| a degree: on average over x by 0.05 · 2/π.
TEST(FlickerPerDegree, IsTheSameAtATwentiethOfTheSpeedWhereMotionMakesItFlicker) {
    const auto crawling = [](glm::dvec2 p, double degrees, int) {
        return 0.1 * std::sin(2 * std::numbers::pi * p.x / size + 0.5 * degrees);
    };
    const Flicker fast = flickerOf(1, crawling), slow = flickerOf(0.05, crawling);
    const double exact = 0.05 * 2 / std::numbers::pi;
    EXPECT_NEAR(*fast.perDegree, exact, 0.02 * exact); // sin 0.25 for 0.25, and 16 pixels for the mean
    EXPECT_NEAR(*slow.perDegree, exact, 0.02 * exact);
    EXPECT_NEAR(slow.mean, fast.mean / 20, 0.001 * fast.mean);
}

// What changes of itself from frame to frame does not care how fast the scene moves: the mean stays.
TEST(FlickerPerDegree, IsTwentyfoldWhereFramesFlickerByThemselves) {
    const auto jittered = [](glm::dvec2, double, int frame) { return frame % 2 == 0 ? 0.1 : -0.1; };
    const Flicker fast = flickerOf(1, jittered), slow = flickerOf(0.05, jittered);
    EXPECT_NEAR(fast.mean, 0.2, 1e-6);
    EXPECT_NEAR(slow.mean, 0.2, 1e-6);
    EXPECT_NEAR(*slow.perDegree, 20 * *fast.perDegree, 1e-6);
}

TEST(FlickerPerDegree, IsAbsentWhereNothingMoves) {
    EXPECT_FALSE(flickerOf(0, [](glm::dvec2, double, int) { return 0.0; }).perDegree);
}

} // namespace
} // namespace shadowbench::metrics
