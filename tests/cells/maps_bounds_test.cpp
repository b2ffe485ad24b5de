// What the shadow maps must show against ground truth, in the gate profile.
#include "cell_stage.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class MapsOnStandardScene : public testing::TestWithParam<std::string> {};

// Two pixels in ten thousand: primary hits of rasteriser and truth that differ by a rounding, as with stencil volumes.
TEST_P(MapsOnStandardScene, AliasFreeMapsAreExactOffEdges) {
    EXPECT_LE(*scored(stillScene(GetParam()), "sm-alias-free").accuracy.mismatchOffEdge, 0.0002);
}

TEST_P(MapsOnStandardScene, FocusingIsNoWorseThanAUniformMap) {
    const Scene scene = stillScene(GetParam());
    const double uniform = *scored(scene, "sm-uniform").accuracy.mismatch;
    EXPECT_LE(*scored(scene, "sm-focused").accuracy.mismatch, uniform);
}

std::string sceneName(const testing::TestParamInfo<std::string>& tested) {
    std::string name = tested.param;
    std::erase(name, '-');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Gate, MapsOnStandardScene, testing::ValuesIn(standardScenes()), sceneName);

TEST(SilhouetteMapOnDuelingFrusta, LeavesAtMostAThirdOfAUniformMapsEdgeError) {
    const Scene scene = stillScene("dueling-frusta");
    const double uniform = scored(scene, "sm-uniform:map=512").accuracy.edgeError->mean;
    EXPECT_LE(scored(scene, "sm-silhouette:map=512").accuracy.edgeError->mean, uniform / 3);
}

} // namespace
} // namespace shadowbench
