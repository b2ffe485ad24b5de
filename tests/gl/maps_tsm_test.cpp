// Trapezoidal shadow maps: like LiSPSM over a long depth range, sensitive to the focus that the user chooses.
#include "ground_score.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// A ground of 200 m seen from a height of 1.7 m, with boxes from 4 m away that grow with distance.
Scene avenueScene() {
    Scene scene = groundScene(256);
    scene.camera = {{0, 1.7, 0}, {0, 1.7, -10}, {0, 1, 0}, 50, 2, 100};
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0.6, -1, -0.1)), {}, {}};
    scene.objects[0] = object(box({200, 0.2, 200}), {0, -0.1, -90});
    for (double depth = 4; depth < 60; depth *= 1.4) {
        const double size = 0.08 * depth;
        scene.objects.push_back(object(box({size, size, size}), {-0.2 * depth, 0.5 * size, -depth}, 10 * depth));
    }
    return scene;
}

TEST(SmTsm, HalvesTheErrorOfAFocusedMapOverALongDepthRange) {
    const Scene scene = avenueScene();
    EXPECT_LE(mismatchOn(1, scene, "sm-tsm"), 0.5 * mismatchOn(1, scene, "sm-focused"));
}

TEST(SmTsm, DependsOnTheFocusThatIsChosen) { // LiSPSM has no such parameter
    const Scene scene = avenueScene();
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
