// Trapezoidal shadow maps: like LiSPSM over a long depth range, sensitive to the focus that the user chooses.
#include "tests/support/ground_score.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(SmTsm, HalvesTheErrorOfAFocusedMapOverALongDepthRange) {
    const Scene scene = avenueScene(2);
    EXPECT_LE(mismatchOn(1, scene, "sm-tsm"), 0.5 * mismatchOn(1, scene, "sm-focused"));
}

TEST(SmTsm, DependsOnTheFocusThatIsChosen) { // LiSPSM has no such parameter
    const Scene scene = avenueScene(2);
    EXPECT_GT(mismatchOn(1, scene, "sm-tsm:focus=0.79"), 1.5 * mismatchOn(1, scene, "sm-tsm"));
}

TEST(SmTsm, IsRightAwayFromEdges) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-tsm"), 3).mismatch, 0);
}

} // namespace
} // namespace shadowbench
