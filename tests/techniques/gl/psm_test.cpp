// Perspective shadow maps: ideal with the light parallel to the image plane; casters behind the eye; the near plane.
#include "tests/support/ground_score.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(SmPsm, HalvesTheErrorOfAUniformMapWithTheLightParallelToTheImagePlane) {
    const Scene scene = avenueScene(2); // the ground comes into view at 3.6 m
    EXPECT_LE(mismatchOn(1, scene, "sm-psm"), 0.5 * mismatchOn(1, scene, "sm-uniform"));
}

TEST(SmPsm, ACloseNearPlaneRuinsIt) {
    const auto mismatch = [](double near, const std::string& variant) { return mismatchOn(1, avenueScene(near), variant); };
    const double far = mismatch(2, "sm-psm"), close = mismatch(0.02, "sm-psm");
    EXPECT_GT(close, 4 * far);
    EXPECT_LT(mismatch(0.02, "sm-psm:shift=4"), 0.5 * close); // the remedy: a virtual camera further back
    EXPECT_LT(mismatch(0.02, "sm-lispsm"), 0.25 * close);
}

TEST(SmPsm, CastersBehindTheEyeNeedARemedy) {
    // The sun stands low behind the viewer, and before it a tall box, whose shadow falls past the eye.
    Scene scene = groundScene(256);
    scene.camera = {{0, 2, 3}, {0, 0, -4}, {0, 1, 0}, 50, 0.5, 60};
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0.1, -0.6, -1)), {}, {}};
    scene.objects[0] = object(box({30, 0.2, 30}), {0, -0.1, 0});
    scene.objects.push_back(object(box({2, 6, 0.5}), {-0.5, 3, 6}, 10));
    EXPECT_LT(mismatchOn(1, scene, "sm-psm"), 0.01);
    EXPECT_LT(mismatchOn(1, scene, "sm-psm:behind=move-back"), 0.01);
    EXPECT_GT(mismatchOn(1, scene, "sm-psm:behind=lost"), 0.1); // the whole shadow is missing
}

TEST(SmPsm, IsRightAwayFromEdgesForLightsBeforeAndBehindTheViewer) {
    for (const glm::dvec3& light : {glm::dvec3(1.7, 6.1, -2.3), glm::dvec3(1.7, 9.1, 9.3), glm::dvec3(-2, 12, -14)}) {
        Scene scene = boxScene(256);
        scene.light.centre = light;
        Stage stage(scene);
        stage.show(0);
        EXPECT_LE(scoreOnGround(scene, stage, rendered(stage, "sm-psm"), 3).mismatch, 1e-4) << light.z;
    }
}

} // namespace
} // namespace shadowbench
