// What tiled and adaptive shadow maps must show against ground truth, in the gate profile, and where they fail.
#include "tests/support/cell_stage.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

double mismatchOf(const std::string& scene, const std::string& variant) {
    return *stillScene(scene).scored(variant).values["accuracy.mismatch"];
}

TEST(TiledMaps, LeaveAtMostHalfOfAUniformMapsErrorAtEqualTexels) {
    for (const char* scene : {"dueling-frusta", "trees", "picket-fence"})
        EXPECT_LE(mismatchOf(scene, "sm-tiled"), 0.5 * mismatchOf(scene, "sm-uniform")) << scene;
}

// Its errors there are on the sides of a column that the light grazes: no depth discontinuity and no pixel's size shows that
// they are narrower than any texel in the light's view. Tiles that serve the rest better serve them worse.
TEST(TiledMaps, AreNoBetterThanAUniformMapWhereTheHeuristicHasNothingToGoBy) {
    EXPECT_GE(mismatchOf("moving-caster", "sm-tiled"), mismatchOf("moving-caster", "sm-uniform"));
}

TEST(AdaptiveMaps, LeaveAtMostHalfOfTheErrorOfAWarpedMap) {
    for (const char* scene : {"dueling-frusta", "windmills", "trees", "colonnade"})
        EXPECT_LE(mismatchOf(scene, "sm-adaptive"), 0.5 * mismatchOf(scene, "sm-lispsm")) << scene;
}

TEST(AdaptiveMaps, ApproachTheTruthWithMoreTexelsAPixel) {
    for (const char* scene : {"dueling-frusta", "trees"}) {
        const double one = mismatchOf(scene, "sm-adaptive:pages=4096");
        const double four = mismatchOf(scene, "sm-adaptive:pages=4096,density=4");
        EXPECT_LE(four, 0.7 * one) << scene; // not a quarter: what the light grazes stays
        EXPECT_LE(four, 0.0025) << scene;
    }
}

TEST(AdaptiveMaps, PayWithManyPasses) {
    const Record& record = stillScene("windmills").counted("sm-adaptive:cache=off");
    ASSERT_TRUE(record.values["cost.work.passes"]);
    EXPECT_GE(record.figures.at("pages"), 200);
    EXPECT_LE(record.figures.at("pages"), 1024);
    EXPECT_GE(*record.values["cost.work.passes"], record.figures.at("pages"));
}

} // namespace
} // namespace shadowbench
