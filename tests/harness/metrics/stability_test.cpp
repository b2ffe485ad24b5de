// Reprojection, flicker, flips and convergence on a camera that moves over a plane.
#include "base/error.h"
#include "harness/metrics/pixels.h"
#include "tests/support/metrics_images.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;
using groundtruth::Reference;
using groundtruth::Surface;

constexpr glm::ivec2 size(64, 64);

Camera cameraAt(double x) {
    Camera camera;
    camera.eye = {x, 0, 0};
    camera.target = {x, 0, -1};
    camera.fovy = 90;
    return camera;
}

/// World point on the plane z = −10 seen by a pixel centre; a pixel is 20/64 m wide there.
glm::dvec3 seen(const Camera& camera, int x, int y) { return camera.eye + 10.0 * camera.ray({x + 0.5, y + 0.5}, size); }

/// The plane z = −10 seen by `camera`, lit where `lit(world)`.
template <typename Lit>
Reference frameOf(const Camera& camera, const Lit& lit) {
    Reference truth = truthOf(size.x, size.y, [](glm::dvec2) { return 0; });
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 point = seen(camera, x, y);
            truth.position(x, y) = point;
            truth.visibility(x, y) = lit(point) ? 1 : 0;
        }
    }
    return truth;
}

Snapshot snapshotOf(const Camera& now, const Camera& before) {
    Snapshot result;
    result.camera = now;
    result.previousCamera = before;
    result.batches.push_back({nullptr, glm::vec3(1), false, {{glm::dmat4(1), glm::dmat4(1), 1}}});
    return result;
}

bool litDisk(const glm::dvec3& p) { return std::hypot(p.x - 0.3, p.y + 0.2) > 3; }

/// The same with the lit share of each pixel, from side × side points of its square.
Image<float> sharesOf(const Camera& camera, int side) {
    return imageOf(size.x, size.y, [&](glm::dvec2 centre) {
        int lit = 0;
        for (int i = 0; i < side * side; ++i) {
            const glm::dvec2 inside = (glm::dvec2(i % side, i / side) + 0.5) / static_cast<double>(side) - 0.5;
            lit += litDisk(camera.eye + 10.0 * camera.ray(centre + inside, size)) ? 1 : 0;
        }
        return static_cast<double>(lit) / (side * side);
    });
}

struct TwoFrames {
    Camera before = cameraAt(0), now = cameraAt(0.53); // 1.7 pixels to the right
    Reference truthBefore = frameOf(before, litDisk), truthNow = frameOf(now, litDisk);
    metrics::Mask maskBefore = everything(truthBefore), maskNow = everything(truthNow);
    Image<glm::vec2> warp = metrics::warp(snapshotOf(now, before), size, truthNow, truthBefore);

    /// With what a technique drew of them.
    [[nodiscard]] metrics::FramePair pair(const Image<float>& vNow, const Image<float>& vBefore) const {
        return {{vNow, truthNow, maskNow}, {vBefore, truthBefore, maskBefore}, warp};
    }
    [[nodiscard]] metrics::FramePair pair(const Image<float>& vNow) const { return pair(vNow, truthBefore.visibility); }
};

TEST(Warp, FollowsTheCamera) {
    const TwoFrames frames;
    const double shift = 0.53 * 64 / 20;
    EXPECT_NEAR(frames.warp(20, 30).x, 20.5 + shift, 1e-4) << "positions are 32-bit";
    EXPECT_NEAR(frames.warp(20, 30).y, 30.5, 1e-4);
    EXPECT_TRUE(std::isnan(frames.warp(63, 30).x)); // was outside the image
}

TEST(Warp, FollowsAMovingSurface) {
    const Camera camera = cameraAt(0);
    const Reference truth = frameOf(camera, litDisk);
    Snapshot now = snapshotOf(camera, camera);
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), glm::radians(30.0), glm::dvec3(0, 0, 1));
    now.batches[0].placements[0] = {turned, glm::translate(turned, glm::dvec3(20.0 / 64, 0, 0)), 1};
    const Image<glm::vec2> warp = metrics::warp(now, size, truth, truth);
    EXPECT_NEAR(warp(30, 30).x, 30.5 + std::cos(glm::radians(30.0)), 1e-4);
    EXPECT_NEAR(warp(30, 30).y, 30.5 - std::sin(glm::radians(30.0)), 1e-4);
}

TEST(Warp, FollowsAMeshThatDeforms) {
    const Camera camera = cameraAt(0);
    const Reference truth = frameOf(camera, litDisk);
    const auto wall = [](double stretched) { // the plane, stretched along x from where the image has its left edge
        const auto x = static_cast<float>(20 * stretched - 10);
        return std::make_shared<const Mesh>(
            Mesh{{{-10, -10, 0}, {x, -10, 0}, {x, 10, 0}, {-10, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    };
    Snapshot now = snapshotOf(camera, camera);
    const glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -10));
    now.batches[0].mesh = wall(1);
    now.batches[0].previousMesh = wall(0.5);
    now.batches[0].placements[0] = {place, place, 1};
    const Image<glm::vec2> warp = metrics::warp(now, size, truth, truth);
    for (const int x : {1, 20, 40, 62}) {
        EXPECT_NEAR(warp(x, 30).x, 0.5 * (x + 0.5), 1e-4);
        EXPECT_NEAR(warp(x, 30).y, 30.5, 1e-4);
    }
}

TEST(Warp, LeavesOutWhatAnotherSurfaceOrDepthHidBefore) {
    const Camera camera = cameraAt(0);
    const Reference truth = frameOf(camera, litDisk);
    Reference before = truth;
    for (int y = 10; y < 14; ++y)
        for (int x = 10; x < 14; ++x) before.id(x, y) = 2;
    for (int y = 30; y < 34; ++y)
        for (int x = 30; x < 34; ++x) before.position(x, y) *= 0.99F; // the same surface, 1 % nearer
    const Image<glm::vec2> warp = metrics::warp(snapshotOf(camera, camera), size, truth, before);
    EXPECT_TRUE(std::isnan(warp(11, 11).x));
    EXPECT_TRUE(std::isnan(warp(31, 31).x));
    EXPECT_FALSE(std::isnan(warp(20, 20).x));
}

TEST(Warp, RefusesReferencesOfDifferentSizes) {
    const Camera camera = cameraAt(0);
    const Reference truth = frameOf(camera, litDisk);
    const Image<std::uint32_t> ids(size.x + 1, size.y);
    const Image<glm::vec3> positions(size.x, size.y + 1);
    const auto refused = [&](const Reference& now, const Reference& before, glm::ivec2 image) {
        EXPECT_THROW(static_cast<void>(metrics::warp(snapshotOf(camera, camera), image, now, before)), InternalError);
    };
    Reference other = truth;
    other.id = ids;
    refused(truth, other, size);
    other = truth;
    other.position = positions;
    refused(truth, other, size);
    refused(other, truth, size);
    refused(truth, truth, {size.x + 1, size.y});
    refused(truth, truth, {size.x, size.y + 1});
}

TEST(Warp, LeavesOutTheBackground) {
    const Camera camera = cameraAt(0);
    Reference truth = frameOf(camera, litDisk);
    truth.id(5, 5) = 0;
    truth.surface(5, 5) = Surface::Background;
    EXPECT_TRUE(std::isnan(metrics::warp(snapshotOf(camera, camera), size, truth, truth)(5, 5).x));
}

TEST(Flicker, IsZeroForTheTruthUnderCameraMotion) {
    const TwoFrames frames;
    const metrics::FramePair pair = frames.pair(frames.truthNow.visibility);
    EXPECT_EQ(metrics::changes(pair).size(), 62U * 64U); // two columns came into view
    const std::optional<metrics::Flicker> flicker = metrics::flicker({{pair}});
    ASSERT_TRUE(flicker);
    EXPECT_EQ(flicker->mean, 0);
    EXPECT_EQ(flicker->p95, 0);
}

TEST(Flicker, IsZeroForAConstantErrorAndTheChangeForAChangingOne) {
    const TwoFrames frames;
    const auto darker = [](const Image<float>& v, float by) {
        Image<float> result = v;
        for (float& value : result) value -= by;
        return result;
    };
    const Image<float> now = darker(frames.truthNow.visibility, 0.25F);
    const Image<float> same = darker(frames.truthBefore.visibility, 0.25F);
    EXPECT_NEAR(metrics::flicker({{frames.pair(now, same)}})->p95, 0, 1e-6) << "bilinear weights in float positions";
    EXPECT_NEAR(metrics::flicker({{frames.pair(now)}})->mean, 0.25, 1e-6);
}

TEST(Flicker, ReadsTheNearestPixelBesideTheMaskAndLeavesOutTheRest) {
    TwoFrames frames;
    frames.maskBefore.scored(32, 30) = 0; // of the four pixels around (30.5 + 1.7, 30.5) this one is the nearest
    frames.maskBefore.scored(40, 40) = 0; // here it is the other one
    EXPECT_EQ(metrics::changes(frames.pair(frames.truthNow.visibility)).size(),
              62U * 64U - 2U); // one pixel maps nearest to each of the two
    EXPECT_FALSE(metrics::flicker({}));
}

TEST(Flicker, OfCrawlingStepsIsMoreThanOfTheirAntialiasedImageAndThatOfTrueAreasIsNone) {
    TwoFrames frames;
    const Image<float> stepsBefore = frames.truthBefore.visibility, stepsNow = frames.truthNow.visibility;
    frames.truthBefore.visibility = sharesOf(frames.before, 32);
    frames.truthNow.visibility = sharesOf(frames.now, 32);
    const auto flickerOf = [&](const Image<float>& now, const Image<float>& before) {
        return *metrics::flicker({{frames.pair(now, before)}});
    };
    EXPECT_EQ(flickerOf(frames.truthNow.visibility, frames.truthBefore.visibility).mean, 0);
    const double steps = flickerOf(stepsNow, stepsBefore).mean;
    const double antialiased = flickerOf(sharesOf(frames.now, 4), sharesOf(frames.before, 4)).mean;
    EXPECT_GT(antialiased, 0);
    EXPECT_GT(steps, 5 * antialiased);
}

TEST(Flicker, HasAsItsFloorWhatAnImageWithoutShadowsScores) {
    const TwoFrames frames;
    const Image<float> lit(size.x, size.y, 1);
    const metrics::Flicker without = *metrics::flicker({{frames.pair(lit, lit)}});
    EXPECT_GT(without.floor, 0);
    EXPECT_NEAR(without.floor, without.mean, 1e-7) << "single changes are floats";
    EXPECT_EQ(metrics::flicker({{frames.pair(frames.truthNow.visibility)}})->floor, without.floor);
}

TEST(Flips, CountClassesThatChangeWhileTheTruthDoesNot) {
    const TwoFrames frames;
    Image<float> now = frames.truthNow.visibility;
    const auto compare = [&] { return metrics::flips(frames.pair(now)); };
    EXPECT_EQ(compare().flipped, 0);
    EXPECT_EQ(compare().compared, 62U * 64U);
    now(5, 5) = 1 - now(5, 5);
    EXPECT_EQ(compare().flipped, 1);
    now(63, 5) = 1 - now(63, 5); // came into view: not compared
    EXPECT_EQ(compare().flipped, 1);
}

TEST(MovingError, SumsSquaresOverFramesAndApartWhereNothingWasSeenBefore) {
    const TwoFrames frames;
    Image<float> v = frames.truthNow.visibility;
    for (int y = 0; y < size.y; ++y) v(63, y) += 0.5F; // of the two columns that came into view
    v(20, 20) += 1;
    EXPECT_FALSE(metrics::movingErrors({}).all);
    const metrics::MovingErrors errors = metrics::movingErrors({{frames.pair(v), frames.pair(v)}});
    EXPECT_NEAR(*errors.all, std::sqrt((64 * 0.25 + 1) / (64.0 * 64)), 1e-9);
    EXPECT_NEAR(*errors.disoccluded, std::sqrt(0.25 / 2), 1e-9);
}

TEST(MovingError, CountsPixelsOfTheMaskOnly) {
    TwoFrames frames;
    frames.maskNow.scored(20, 20) = 0;
    Image<float> v = frames.truthNow.visibility;
    v(20, 20) += 1;
    EXPECT_EQ(metrics::movingErrors({{frames.pair(v)}}).all, 0.0);
    v(21, 20) += 1;
    EXPECT_NEAR(*metrics::movingErrors({{frames.pair(v)}}).all, std::sqrt(1 / (64.0 * 64 - 1)), 1e-12);
}

std::optional<int> convergence(const std::vector<double>& errors) {
    const std::vector<Image<std::uint8_t>> pictures;
    const metrics::Mask mask;
    return metrics::convergence({pictures, errors, mask});
}

TEST(Convergence, IsTheFirstFrameOfTheSteadyState) {
    std::vector<double> error(40, 0.1);
    error[0] = 0.8;
    error[1] = 0.4;
    error[2] = 0.2;
    EXPECT_EQ(convergence(error), 4);
    error[10] = 0.106; // a relapse
    EXPECT_EQ(convergence(error), 12);
    error[10] = 0.104; // within 5 %
    EXPECT_EQ(convergence(error), 4);
}

TEST(Convergence, OfASteadyErrorIsTheFirstFrame) {
    EXPECT_EQ(convergence({0.3}), 1);
    EXPECT_EQ(convergence({0, 0, 0}), 1);
}

TEST(Convergence, IsAbsentForNoFramesAndForARestlessEnd) {
    EXPECT_FALSE(convergence({}));
    std::vector<double> error(20, 0.1);
    error.back() = 0.2; // the mean of the last two is 0.15
    EXPECT_FALSE(convergence(error));
}

} // namespace
} // namespace shadowbench
