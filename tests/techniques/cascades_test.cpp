// Partition of the view frustum and of an atlas, against closed forms.
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/maps/depth_atlas.h"

#include <cmath>
#include <gtest/gtest.h>

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

TEST(Tiles, ShareAtMostTheTexelsOfOneMap) {
    for (int count = 1; count <= 8; ++count)
        for (const auto& tiles : {equalTiles(1024, count), squareTiles(1024, count)}) {
            ASSERT_EQ(tiles.size(), static_cast<std::size_t>(count));
            int texels = 0;
            for (const Tile& tile : tiles) texels += tile.size.x * tile.size.y;
            EXPECT_LE(texels, 1024 * 1024);
            EXPECT_GE(texels, 0.99 * 1024 * 1024) << count; // what whole texels leave over
        }
    EXPECT_EQ(equalTiles(1024, 4)[3], (Tile{{512, 512}, {512, 512}}));
}

} // namespace
} // namespace shadowbench::techniques
