// Cascaded shadow maps: where perspective is what spoils a single map, and where it is not.
#include "tests/support/ground_score.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(SmCascaded, LeavesAQuarterOfTheErrorAtEqualTexelsOverALongDepthRange) {
    const Scene scene = avenueScene(0.5);
    const double focused = mismatchOn(1, scene, "sm-focused:map=512");
    EXPECT_LE(mismatchOn(1, scene, "sm-cascaded:map=512,lambda=1"), 0.25 * focused);
    EXPECT_LE(mismatchOn(1, scene, "sm-cascaded:map=512"), 0.5 * focused);
}

TEST(SmCascaded, OneSliceIsTheFocusedMap) {
    const Scene scene = boxScene(128);
    Stage stage(scene);
    stage.show(0);
    EXPECT_LE(differing(rendered(stage, "sm-cascaded:slices=1"), rendered(stage, "sm-focused")), 20U); // rounding at edges
}

TEST(SmCascaded, IsRightAwayFromEdgesForAnyNumberOfSlices) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    for (const char* variant :
         {"sm-cascaded:slices=2", "sm-cascaded:slices=3", "sm-cascaded:slices=7", "sm-cascaded:warp=lispsm"})
        EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, variant), 3).mismatch, 0) << variant;
}

TEST(SmCascaded, LeavesProjectiveAliasing) {
    // A wall that the sun grazes, at one distance from the camera: slices have nothing to share out.
    Scene scene = groundScene(256);
    scene.camera = {{0, 2, 12}, {0, 2, 0}, {0, 1, 0}, 30, 0.5, 40};
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0.3, -1, -0.06)), {}, {}};
    scene.objects[0] = object(box({12, 8, 0.2}), {0, 2, 0});
    scene.objects.push_back(object(box({4, 0.1, 0.5}), {-0.5, 3.5, 0.6}, 25));
    const double focused = mismatchOn(1, scene, "sm-focused:map=256");
    EXPECT_GT(focused, 0.001);
    EXPECT_GT(mismatchOn(1, scene, "sm-cascaded:map=256"), 0.7 * focused);
}

} // namespace
} // namespace shadowbench
