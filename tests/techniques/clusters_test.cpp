// Blockers are put into clusters of like depth.
#include "techniques/soft/convolution/clusters.h"

#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

TEST(Clusters, AreSplitAtTheWidestGapUntilTheySpreadLittle) {
    // 1 / depth: 0.5 … 0.49, 0.25, 0.24, 0.1
    const std::vector<BlockerDepths> plates{{10, 10}, {4, 4}, {2, 1 / 0.49}, {1 / 0.24, 1 / 0.24}};
    EXPECT_EQ(clustered(plates, 1, 8).ranges.size(), 1U);
    const Clusters three = clustered(plates, 0.02, 8);
    ASSERT_EQ(three.ranges.size(), 3U);
    EXPECT_EQ(three.of[1], three.of[3]);
    EXPECT_NE(three.of[0], three.of[1]);
    EXPECT_NE(three.of[2], three.of[1]);
    EXPECT_EQ(clustered(plates, 0.001, 8).ranges.size(), 4U); // one blocker cannot be split
    EXPECT_EQ(clustered(plates, 0.001, 2).ranges.size(), 2U);
    EXPECT_TRUE(clustered({}, 0.1, 8).ranges.empty());
}

TEST(Clusters, HaveTheirPlaneWherePenumbraeAreHalfwayBetweenThoseOfBothEnds) {
    const BlockerDepths range{2, 4};
    EXPECT_DOUBLE_EQ(1 / range.middle(), 0.5 * (0.5 + 0.25));
    EXPECT_DOUBLE_EQ(range.spread(), 0.25);
}

} // namespace
} // namespace shadowbench::techniques
