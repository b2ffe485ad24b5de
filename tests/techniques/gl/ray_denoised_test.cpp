// A denoiser guided by variance over one ray a pixel: how much noise it removes, what it keeps apart, and what it is slow to
// forget.
#include "tests/support/leaving_shadow.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(RayDenoised, LeavesATenthOfARaysNoise) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const double raw = penumbraRmsError(slabPoints(stage, imageAfter(stage, "ray-traced", 1)));
    const double first = penumbraRmsError(slabPoints(stage, imageAfter(stage, "ray-denoised", 1)));
    const double later = penumbraRmsError(slabPoints(stage, imageAfter(stage, "ray-denoised", 30)));
    EXPECT_LT(first, 0.4 * raw); // over neighbours alone
    EXPECT_LT(later, 0.1 * raw);
    EXPECT_LT(later, 0.5 * first);
}

TEST(RayDenoised, NothingIsDoneWhereNothingIsNoisy) {
    Scene scene = halfPlaneScene();
    scene.objects[1] = object(box({1, 1, 1}), {0.3, -3, 0}); // below the slab
    Stage stage(scene);
    stage.show(0);
    for (const SlabPoint& point : slabPoints(stage, imageAfter(stage, "ray-denoised", 5)))
        ASSERT_NEAR(point.visibility, 1, 1e-5);
}

/// Over what length a hard shadow's edge is blurred.
double blurredOver(const std::string& variant) {
    Scene scene = halfPlaneScene();
    scene.light.u.x = scene.light.v.z = 0.001;
    Stage stage(scene);
    stage.show(0);
    return widthBetween(slabPoints(stage, imageAfter(stage, variant, 10)), 0.05, 0.95);
}

TEST(RayDenoised, VarianceKeepsAnEdgeThatHasNone) {
    EXPECT_LT(blurredOver("ray-denoised"), 0.1); // two pixels
    EXPECT_GT(blurredOver("ray-denoised:guided=off"), 0.5);
}

TEST(RayDenoised, ShadowsOfWhatHasGoneFade) { // Graphics#2482: ghosts
    EXPECT_NEAR(leftOfTheUmbra("ray-denoised", 1.2, 2), 0.8 * 0.8, 0.1);
}

} // namespace
} // namespace shadowbench
