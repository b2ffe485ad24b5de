// Variance soft shadow maps against the half-plane's ramp: of two depths parallel to the map, moments know the share and the
// blockers' depth.
#include "tests/support/modern_rows.h"
#include "tests/support/soft_scenes.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Vssm, APenumbraUnderAParallelBlockerIsTheRampOfSimilarTriangles) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto points = slabPoints(stage, renderedModern(stage, "vssm"));
    EXPECT_LT(penumbraRmsError(points), 0.03); // a texel of the map, and the mean of blockers where few are in the window
    EXPECT_NEAR(widthBetween(points, 0.02, 0.98), 0.96 * (umbraFrom - litUntil), 0.06);
    EXPECT_LT(visibilityAt(points, umbraFrom + 0.2), 0.01);
    EXPECT_GT(visibilityAt(points, litUntil - 0.2), 0.99);
}

TEST(Vssm, APointLightHasAHardEdge) {
    Scene scene = halfPlaneScene();
    scene.light = {LightKind::Point, {0.1, 6, 0.2}, {0, -1, 0}, {}, {}};
    Stage stage(scene);
    stage.show(0);
    EXPECT_LT(widthBetween(slabPoints(stage, renderedModern(stage, "vssm")), 0.02, 0.98), 0.05);
}

TEST(Vssm, ALitSurfaceIsLitAtASlant) {
    Scene scene = halfPlaneScene();
    scene.objects.pop_back();
    scene.light.centre = {5.1, 3, 0.2};
    Stage stage(scene);
    stage.show(0);
    for (const SlabPoint& point : slabPoints(stage, renderedModern(stage, "vssm"))) ASSERT_GT(point.visibility, 0.95);
}

// Section 4 of the paper: beside a farther occluder's edge the kernel's mean lies behind what is blocked.
TEST(Vssm, PartsOfAKernelFindBlockersThatItsMeanDoesNotShow) {
    const Scene scene = steepSideScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> whole = renderedModern(stage, "vssm", "parts=1"), parts = renderedModern(stage, "vssm");
    double more = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) more += std::abs(double(whole[i]) - double(parts[i]));
    EXPECT_GT(more, 0);
}

} // namespace
} // namespace shadowbench
