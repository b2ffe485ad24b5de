// The pictures that show one instance's transition.
#include "harness/cells/lod_images.h"

#include <gtest/gtest.h>

namespace shadowbench::lod {
namespace {

/// A square of `side` pixels of instance `id`.
Image<unsigned> mask(unsigned id, glm::ivec2 corner, int side) {
    Image<unsigned> result(40, 30);
    for (int y = corner.y; y < corner.y + side; ++y)
        for (int x = corner.x; x < corner.x + side; ++x) result(x, y) = id;
    return result;
}

TEST(TransitionCrops, FollowTheInstanceThatMostPixelsSee) {
    std::vector<Image<unsigned>> masks{mask(5, {2, 3}, 2), mask(7, {10, 10}, 6), mask(7, {14, 12}, 8),
                                       Image<unsigned>(40, 30)};
    const std::vector<Crop> crops = transitionCrops(masks);
    ASSERT_EQ(crops.size(), 2U); // the frames that see instance 7
    EXPECT_EQ(crops[0].frame, 1);
    EXPECT_EQ(crops[1].frame, 2);
    for (const Crop& crop : crops) EXPECT_EQ(crop.side, 14); // the larger square with 3 pixels around
    EXPECT_EQ(crops[0].corner, glm::ivec2(5, 5));
    EXPECT_EQ(crops[1].corner, glm::ivec2(10, 8));
    EXPECT_TRUE(transitionCrops({Image<unsigned>(40, 30)}).empty());
}

TEST(TransitionCrops, StayInsideThePictureAndAreEightAtMost) {
    const std::vector<Image<unsigned>> masks(30, mask(3, {0, 26}, 4));
    const std::vector<Crop> crops = transitionCrops(masks);
    ASSERT_EQ(crops.size(), 8U);
    EXPECT_EQ(crops[0].corner, glm::ivec2(0, 20));
    for (std::size_t i = 1; i < crops.size(); ++i) EXPECT_GT(crops[i].frame, crops[i - 1].frame);
}

TEST(TransitionStrip, PutsEnlargedCropsSideBySide) {
    metrics::ColourImage picture(40, 30, {9, 9, 9});
    picture(6, 7) = {200, 100, 50};
    const metrics::ColourImage result = strip({{4, {5, 5}, 10}, {4, {6, 7}, 10}}, {{4, picture}});
    EXPECT_EQ(result.height(), 150); // fifteenfold
    EXPECT_EQ(result.width(), 302);
    EXPECT_EQ(result(15, 30), picture(6, 7));
    EXPECT_EQ(result(14, 30), picture(5, 7));
    EXPECT_EQ(result(150, 0), glm::u8vec3(255)); // between them
    EXPECT_EQ(result(152, 0), picture(6, 7));
}

} // namespace
} // namespace shadowbench::lod
