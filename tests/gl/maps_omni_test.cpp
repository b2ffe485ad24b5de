// Maps for lights inside the scene.
#include "ground_score.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr float slabTop = -0.001F;

/// Draw calls of a frame.
std::uint64_t drawsOf(Stage& stage, const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto technique = variant.entry->make(variant.parameters);
    const std::uint64_t before = testContext().tally().draws;
    stage.render(*technique, 0, 1);
    return testContext().tally().draws - before;
}

TEST(SmCube, HoldsAllAroundALightInsideTheSceneWhereOneMapCannot) {
    const Scene scene = ringScene();
    // Half a texel of 418 over 90° is under 2 px where the slab is seen; edges are what is left.
    EXPECT_LT(mismatchOn(1, scene, "sm-cube", slabTop), 0.015);
    EXPECT_LT(mismatchOn(1, scene, "sm-cube:map=4096", slabTop), 0.3 * mismatchOn(1, scene, "sm-cube", slabTop));
    EXPECT_GT(mismatchOn(1, scene, "sm-uniform", slabTop), 0.05);
}

TEST(SmCube, IsRightAwayFromEdges) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-cube:map=2048"), 3).mismatch, 0);
}

TEST(SmCube, DrawsTheSceneSixTimes) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(drawsOf(stage, "sm-cube") - 1, 6 * (drawsOf(stage, "sm-uniform") - 1)); // one draw is the resolve
}

} // namespace
} // namespace shadowbench
