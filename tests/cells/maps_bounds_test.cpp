// What the shadow maps must show against ground truth, in the gate profile.
#include "scene/load/load.h"
#include "tests/support/cell_stage.h"
#include "tests/support/test_names.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class MapsOnStandardScene : public testing::TestWithParam<std::string> {};

// Two pixels in ten thousand: primary hits of rasteriser and truth that differ by a rounding, as with stencil volumes.
TEST_P(MapsOnStandardScene, AliasFreeMapsAreExactOffEdges) {
    EXPECT_LE(*stillScene(GetParam()).scored("sm-alias-free").values["accuracy.mismatch_off_edge"], 0.0002);
}

TEST_P(MapsOnStandardScene, FocusingIsNoWorseThanAUniformMap) {
    CellScene& scene = stillScene(GetParam());
    const double uniform = *scene.scored("sm-uniform").values["accuracy.mismatch"];
    EXPECT_LE(*scene.scored("sm-focused").values["accuracy.mismatch"], uniform);
}

INSTANTIATE_TEST_SUITE_P(Gate, MapsOnStandardScene, testing::ValuesIn(standardScenes()), nameOfText);

// Not at most half: the visible depths have a ratio of 6, and of a focused map with four times the texels, which is more
// than slices can give, 0.55 of the error is left.
TEST(CascadedMapsOnWindmills, AreBetterThanOneFocusedMapOfEqualTexels) {
    CellScene& scene = stillScene("windmills");
    const double focused = *scene.scored("sm-focused").values["accuracy.mismatch"];
    EXPECT_LE(*scene.scored("sm-cascaded").values["accuracy.mismatch"], 0.8 * focused);
    EXPECT_GE(*scene.scored("sm-focused:map=2048").values["accuracy.mismatch"], 0.5 * focused);
}

TEST(CascadedMapsOnTheAvenue, LeaveAtMostHalfOfAFocusedMapsError) {
    CellScene& scene = stillScene("avenue");
    const double focused = *scene.scored("sm-focused").values["accuracy.mismatch"];
    for (const char* variant : {"sm-cascaded", "sm-cascaded:fit=view,lambda=0.5", "sm-cascaded:slices=2,warp=lispsm"})
        EXPECT_LE(*scene.scored(variant).values["accuracy.mismatch"], 0.5 * focused) << variant;
}

TEST(PerspectiveMapOnDuelingFrusta, IsWithinAFactorTwoOfAUniformMap) { // course: it degenerates to one
    CellScene& scene = stillScene("dueling-frusta");
    const double uniform = *scene.scored("sm-uniform").values["accuracy.mismatch"];
    const double perspective = *scene.scored("sm-psm").values["accuracy.mismatch"];
    EXPECT_LE(perspective, 2 * uniform);
    EXPECT_GE(perspective, 0.5 * uniform);
}

TEST(SilhouetteMapOnDuelingFrusta, LeavesAtMostAThirdOfAUniformMapsEdgeError) {
    CellScene& scene = stillScene("dueling-frusta");
    const double uniform = *scene.scored("sm-uniform:map=512").values["accuracy.edge_error.mean"];
    EXPECT_LE(*scene.scored("sm-silhouette:map=512").values["accuracy.edge_error.mean"], uniform / 3);
}

} // namespace
} // namespace shadowbench
