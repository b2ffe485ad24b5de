// What the moving and the still frames of a technique score, on a plane in front of a camera at rest.
#include "base/error.h"
#include "harness/metrics/pixels.h"
#include "tests/support/metrics_images.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;
using groundtruth::Reference;
using groundtruth::Surface;

constexpr int side = 10;
const glm::vec2 nowhere(std::numeric_limits<float>::quiet_NaN());

/// Two frames of a plane whose right half is lit; every pixel was where it is.
struct Still {
    Reference truth = HalfPlane{{1, 0}, 5}.truth(side, side);
    metrics::Mask mask = everything(truth);
    Image<float> now = truth.visibility, before = truth.visibility;
    Image<glm::vec2> warp = here();

    static Image<glm::vec2> here() {
        Image<glm::vec2> positions(side, side);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) positions(x, y) = glm::vec2(x, y) + 0.5F;
        return positions;
    }
    [[nodiscard]] metrics::FramePair pair() const { return {{now, truth, mask}, {before, truth, mask}, warp}; }
    [[nodiscard]] metrics::MovingFrames twice() const { return {{pair(), pair()}}; }
};

TEST(FlipRate, IsOfAllPixelsOfAllFramesThatTheFrameBeforeShows) {
    Still frames;
    frames.now(7, 2) = 0;        // lit before
    frames.warp(0, 0) = nowhere; // came into view: not compared, whatever it shows
    frames.now(0, 0) = 1;
    EXPECT_DOUBLE_EQ(*metrics::flipRate(frames.twice()), 2.0 / (2 * 99));
    EXPECT_FALSE(metrics::flipRate({}));
}

TEST(FlipRate, LeavesOutWhatLeavesTheImageTheMaskOrTheSurface) {
    Still frames;
    frames.warp(0, 0) = {-0.5F, 3}; // left of the image
    frames.warp(1, 0) = {3, side + 0.5F};
    frames.truth.id(2, 0) = 2; // this surface was nowhere before
    frames.warp(2, 0) = {5.5F, 5.5F};
    frames.mask.scored(3, 0) = 0;
    --frames.mask.count;
    EXPECT_EQ(metrics::flips(frames.pair()).compared, 96U);
    EXPECT_EQ(metrics::changes(frames.pair()).size(), 96U);
}

TEST(MovingPixels, AreCountedByWhatTheyCanBeComparedWith) {
    Still frames;
    for (int x = 0; x < 3; ++x) frames.warp(x, 0) = nowhere;
    frames.mask.scored(9, 9) = 0;
    --frames.mask.count;
    const metrics::MovingPixels pixels = metrics::movingPixels(frames.twice());
    EXPECT_EQ(pixels.all, 2 * 99);
    EXPECT_EQ(pixels.disoccluded, 2 * 3);
    EXPECT_EQ(pixels.compared, 2 * 96);
}

TEST(Reuse, IsTheShareOfSurfacePixelsThatWereThere) {
    Still frames;
    for (int x = 0; x < 3; ++x) frames.warp(x, 0) = nowhere;
    for (int x = 0; x < side; ++x) frames.truth.surface(x, 9) = Surface::Background;
    for (int x = 0; x < side; ++x) frames.warp(x, 9) = nowhere;
    EXPECT_DOUBLE_EQ(*metrics::reuse(frames.twice()), 87.0 / 90);
    for (Surface& surface : frames.truth.surface) surface = Surface::Background;
    EXPECT_FALSE(metrics::reuse(frames.twice())) << "an empty sky";
}

TEST(FlickerMap, HoldsEachPixelsChangeBeyondTheTruths) {
    Still frames;
    frames.before(7, 2) = 0.75F;
    frames.before(0, 0) = 0.5F;
    frames.warp(0, 0) = nowhere;
    const Image<float> map = metrics::flickerMap(frames.pair());
    EXPECT_EQ(map(7, 2), 0.25F);
    EXPECT_EQ(map(0, 0), 0) << "was not seen before";
    EXPECT_EQ(map(3, 3), 0);
    EXPECT_FALSE(metrics::flicker({})) << "no pair";
}

TEST(FlickerMap, OfAChangeAgainstTheTruthsIsTheSumOfBoth) {
    Still frames;
    Reference before = frames.truth;
    before.visibility(7, 2) = 1 - frames.truth.visibility(7, 2);
    const float change = frames.truth.visibility(7, 2) - before.visibility(7, 2);
    frames.before(7, 2) = frames.now(7, 2) + 0.25F * change;
    const metrics::FramePair pair{
        {frames.now, frames.truth, frames.mask}, {frames.before, before, frames.mask}, frames.warp};
    EXPECT_EQ(metrics::flickerMap(pair)(7, 2), 1.25F);
    EXPECT_NEAR(metrics::flicker(metrics::MovingFrames{{pair}})->mean, 1.25 / (side * side), 1e-9);
}

TEST(MovingFrames, OfDifferentSizesAreAnError) {
    const Still frames;
    const Reference small = HalfPlane{{1, 0}, 5}.truth(side, side - 1);
    const metrics::Mask mask = everything(small);
    EXPECT_THROW(metrics::flips({{frames.now, frames.truth, frames.mask}, {small.visibility, small, mask}, frames.warp}),
                 InternalError);
    EXPECT_THROW(metrics::flips({{frames.now, frames.truth, frames.mask},
                                 {frames.before, frames.truth, frames.mask},
                                 Image<glm::vec2>(side, side - 1)}),
                 InternalError);
    EXPECT_THROW(metrics::warp({}, {side, side - 1}, frames.truth, frames.truth), InternalError);
    EXPECT_THROW(metrics::warp({}, {side, side}, frames.truth, small), InternalError);
    EXPECT_THROW(metrics::receiverMask(frames.truth, {small.id, small.position}, {}), InternalError);
}

TEST(ChangedByFrame, IsTheShareOfReceiversThatDifferFromTheLastFrameByMoreThanThirty) {
    std::vector<Image<std::uint8_t>> pictures(3, Image<std::uint8_t>(side, side, 100));
    for (int x = 0; x < side; ++x) pictures[0](x, 0) = 131;
    for (int x = 0; x < side; ++x) pictures[1](x, 0) = 70; // 30 less: not visible
    pictures[1](0, 5) = 69;
    metrics::Mask mask = everything(HalfPlane{{1, 0}, 5}.truth(side, side));
    for (int x = 0; x < 5; ++x) mask.scored(x, 0) = 0;
    mask.count = 95;
    const std::vector<double> errors(3, 0.1);
    metrics::Values values;
    metrics::computeLists({pictures, errors, mask}, values);
    EXPECT_EQ(values.list("stability.by_frame.changed"), (std::vector<double>{5.0 / 95, 1.0 / 95, 0}));
}

TEST(VisibilityInBytes, RoundsAndClamps) {
    Image<float> v(5, 1);
    v(0, 0) = -0.5F;
    v(1, 0) = 0.49F / 255;
    v(2, 0) = 0.51F / 255;
    v(3, 0) = 1;
    v(4, 0) = 7;
    const Image<std::uint8_t> bytes = metrics::inBytes(v);
    EXPECT_EQ((std::vector<int>(bytes.begin(), bytes.end())), (std::vector<int>{0, 0, 1, 255, 255}));
}

TEST(MovingFrameValues, AreThoseOfAllLinesOfTheirKind) {
    const Still frames;
    metrics::Values values;
    metrics::compute<metrics::OfMovingFrames>(frames.twice(), values);
    metrics::compute<metrics::OfMovingAreas>(frames.twice(), values);
    for (const char* path : {"stability.flip_rate", "stability.moving_rmse", "stability.reuse", "stability.pixels.moving",
                             "stability.flicker.mean", "stability.flicker.p95"})
        EXPECT_TRUE(values[*metrics::metricAt(path)]) << path;
    EXPECT_FALSE(values["stability.ghost_half_life"]) << "no history";
}

} // namespace
} // namespace shadowbench
