// Scores of a level-of-detail technique over a walk whose frames are known numbers.
#include "harness/metrics/frames.h"
#include "harness/metrics/values.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench::metrics {
namespace {

Walk walk() {
    Walk seen;
    seen.standingChange = {0.01, 0.04, 0.02};
    seen.standingRegion = {3, 41, 7};
    seen.change = {-0.003, -0.001, -0.002}; // coarse levels change less than lod-full
    seen.square = {0.0, 0.0009, 0.0027};
    seen.speckle = {1, 2, 3};
    seen.primitives = {900, 1000, 1100, 880};
    seen.referenceSpeckle = 4.5;
    seen.maskPixels = 30;
    seen.transitions = 19;
    seen.orderSquare = 0.0004;
    return seen;
}

Values scoresOf(const Walk& seen) {
    Values values;
    compute<OfWalk>(seen, values);
    return values;
}

TEST(WalkScores, AreTheWorstFrameOfWhatPopsAndTheMeanOfWhatIsDrawn) {
    const Values scores = scoresOf(walk());
    EXPECT_EQ(scores["lod.pop"], 0.04);
    EXPECT_EQ(scores["lod.changed_region"], 41);
    EXPECT_EQ(scores["lod.walk_pop"], -0.001) << "the largest, though all are below lod-full's";
    EXPECT_NEAR(*scores["lod.colour_error"], std::sqrt(0.0012), 1e-15);
    EXPECT_NEAR(*scores["lod.order_error"], 0.02, 1e-15);
    EXPECT_EQ(scores["lod.transitions"], 19);
    EXPECT_NEAR(*scores["lod.primitives"], 970, 1e-9);
}

TEST(WalkScores, ChangeOfPrimitivesIsRelativeAndLeavesOutTheFirstFrame) {
    EXPECT_NEAR(*scoresOf(walk())["lod.primitive_change"], 0.2, 1e-15) << "from 1100 to 880";
    Walk still = walk();
    still.primitives = {10, 1000}; // the first has no levels to come from
    EXPECT_EQ(scoresOf(still)["lod.primitive_change"], 0);
}

TEST(WalkScores, NoiseIsWhatLodFullHasNotAndAbsentWithoutATransition) {
    EXPECT_NEAR(*scoresOf(walk())["lod.noise"], 0.05, 1e-15);
    Walk smooth = walk();
    smooth.referenceSpeckle = 9;
    EXPECT_NEAR(*scoresOf(smooth)["lod.noise"], -0.1, 1e-15) << "smoother than lod-full";
    smooth.maskPixels = 0;
    EXPECT_FALSE(scoresOf(smooth)["lod.noise"]);
}

} // namespace
} // namespace shadowbench::metrics
