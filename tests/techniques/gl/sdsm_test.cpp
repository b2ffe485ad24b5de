// Sample distribution shadow maps: what they gain, and what a fit that is a frame late misses.
#include "tests/support/ground_score.h"
#include "tests/support/rows_over_frames.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// The avenue from above, nothing of which is near; a tower far off makes the scene as high as the camera is.
Scene towerScene() {
    Scene scene = avenueScene(0.5);
    scene.camera.eye = {0, 40, 10};
    scene.camera.target = {-4, 0, -25};
    scene.objects.push_back(object(box({2, 60, 2}), {90, 30, -90}));
    return scene;
}

/// What stands there, seen from `eye` towards `target`.
Snapshot seenFrom(const Scene& scene, const glm::dvec3& eye, const glm::dvec3& target) {
    Snapshot seen = snapshot(scene, 0);
    seen.camera.eye = eye;
    seen.camera.target = target;
    return seen;
}

/// Pixels of the ground that differ from exact shadows.
std::size_t wrongPixels(Stage& stage, const Image<float>& image) {
    const Image<float> exact = rendered(stage, "sm-alias-free");
    const metrics::Drawn drawn = stage.drawn();
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.size(); ++i) count += drawn.id[i] == 1 && image[i] != exact[i] ? 1 : 0;
    return count;
}

TEST(Sdsm, LeavesAFractionOfTheErrorOfFrustaWhereLittleOfTheDepthIsSeen) {
    const Scene scene = towerScene();
    Stage stage(scene);
    stage.show(0);
    const std::size_t frusta = wrongPixels(stage, imageAfter(stage, "sm-cascaded:map=256,fit=view", 1));
    EXPECT_GT(frusta, 100U);
    EXPECT_LT(wrongPixels(stage, imageAfter(stage, "sdsm:map=256", 2)), frusta / 2);
    EXPECT_LT(wrongPixels(stage, imageAfter(stage, "sdsm:map=128", 2)), frusta); // of a quarter of the texels
}

TEST(Sdsm, WithoutLatencyIsTheCascadesThatAreFittedToWhatIsSeen) {
    const Scene scene = towerScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(differing(imageAfter(stage, "sdsm:latency=0", 1), imageAfter(stage, "sm-cascaded", 1)), 0U);
}

TEST(Sdsm, TheFirstFrameIsFittedToItsFrustumAndTheNextToWhatWasSeen) {
    const Scene scene = towerScene();
    Stage stage(scene);
    stage.show(0);
    const auto row = rowOf("sdsm");
    const Image<float> first = imageAfter(stage, *row, 1), second = imageAfter(stage, *row, 1);
    EXPECT_EQ(differing(first, imageAfter(stage, "sm-cascaded:fit=view", 1)), 0U);
    EXPECT_EQ(differing(second, imageAfter(stage, "sm-cascaded", 1)), 0U);
    row->reset();
    EXPECT_EQ(differing(imageAfter(stage, *row, 1), first), 0U);
}

TEST(Sdsm, AFrameAfterACutIsWrongAndTheNextRight) {
    const Scene scene = avenueScene(0.5);
    Stage stage(scene);
    const auto late = rowOf("sdsm"), waiting = rowOf("sdsm:latency=0");
    stage.show(seenFrom(scene, {0, 1.7, -20}, {0, 0, -24}));
    imageAfter(stage, *late, 2);
    stage.show(seenFrom(scene, {0, 1.7, -1}, {0, 0.2, -8}));
    const std::size_t least = wrongPixels(stage, imageAfter(stage, *waiting, 1));
    EXPECT_GT(wrongPixels(stage, imageAfter(stage, *late, 1)), 10 * least + 500);
    EXPECT_EQ(wrongPixels(stage, imageAfter(stage, *late, 1)), least);
}

TEST(Sdsm, ALateFitFollowsTheLight) { // maps are drawn from where the light is now; the region alone is old
    Scene scene = towerScene();
    Stage stage(scene);
    stage.show(0);
    const auto row = rowOf("sdsm");
    imageAfter(stage, *row, 2);
    scene.light.direction = glm::normalize(glm::dvec3(-0.4, -1, 0.3));
    stage.show(snapshot(scene, 0));
    const Image<float> turned = imageAfter(stage, *row, 1);
    EXPECT_LT(wrongPixels(stage, turned), 2 * wrongPixels(stage, imageAfter(stage, "sm-cascaded:fit=view", 1)));
}

} // namespace
} // namespace shadowbench
