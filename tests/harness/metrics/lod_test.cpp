// Metrics of level-of-detail pictures on images whose answers are known.
#include "base/error.h"
#include "harness/metrics/lod.h"

#include <gtest/gtest.h>

namespace shadowbench::metrics {
namespace {

constexpr glm::u8vec3 black{0, 0, 0}, white{255, 255, 255};

ColourImage plain(glm::u8vec3 colour = black, int side = 10) { return {side, side, colour}; }

TEST(LodMetrics, ChangeIsTheMeanOverPixelsAndChannels) {
    ColourImage image = plain();
    image(3, 4) = {255, 0, 0};
    EXPECT_DOUBLE_EQ(meanChange(plain(), image), 1.0 / 300);
    image(3, 5) = {0, 51, 0}; // a fifth
    EXPECT_DOUBLE_EQ(meanChange(image, plain()), 1.2 / 300);
    EXPECT_DOUBLE_EQ(meanSquare(plain(), image), 1.04 / 300);
    EXPECT_EQ(meanChange(image, image), 0);
}

TEST(LodMetrics, RegionsAreConnectedBySidesAndOnlyVisibleChangesCount) {
    ColourImage now = plain();
    for (const auto& [x, y] : {std::pair{1, 1}, {2, 1}, {2, 2}, {3, 3}}) now(x, y) = white; // the last by a corner only
    now(7, 7) = {30, 30, 30};                                                               // not visible
    EXPECT_EQ(largestChangedRegion(now, plain()), 3U);
    EXPECT_EQ(largestChangedRegion(plain(), now), 3U);
    now(7, 7) = {31, 0, 0};
    now(3, 2) = white;
    EXPECT_EQ(largestChangedRegion(now, plain()), 5U);
}

TEST(LodMetrics, SpeckleIsIsolatedPixelsNotEdges) {
    const Image<unsigned> everywhere(10, 10, 1);
    EXPECT_EQ(speckle(plain(white), everywhere), 0);
    ColourImage edge = plain();
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 5; ++x) edge(x, y) = white;
    EXPECT_EQ(speckle(edge, everywhere), 0);
    ColourImage dots = plain();
    dots(2, 2) = white;
    dots(7, 7) = {255, 0, 0};
    EXPECT_DOUBLE_EQ(speckle(dots, everywhere), 1 + 1.0 / 3);
    Image<unsigned> corner(10, 10);
    corner(2, 2) = 9;
    EXPECT_DOUBLE_EQ(speckle(dots, corner), 1);
}

TEST(LodMetrics, PicturesOfDifferentSizesAreAnError) {
    EXPECT_THROW(meanChange(plain(), plain(black, 9)), InternalError);
    EXPECT_THROW(largestChangedRegion(plain(), plain(black, 9)), InternalError);
    EXPECT_THROW(speckle(plain(), Image<unsigned>(3, 3)), InternalError);
}

} // namespace
} // namespace shadowbench::metrics
