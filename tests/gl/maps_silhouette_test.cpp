// Shadow silhouette maps: exact on straight edges, wrong where two edges share a texel.
#include "ground_score.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr float slabTop = -0.001F;

TEST(SmSilhouette, ReconstructsStraightEdgesExactly) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const double uniform = scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=128"), 0).mismatch;
    const double silhouette = scoreOnGround(scene, stage, rendered(stage, "sm-silhouette:map=128"), 0).mismatch;
    EXPECT_LT(silhouette, 0.1 * uniform); // corners of the polygon, where a texel holds one point of two edges, are left
}

TEST(SmSilhouette, IsTheDepthMapsTestAwayFromOutlines) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-silhouette"), 2).mismatch, 0);
}

/// The slab under `count` bars of this width, each separated from the next by as much.
Scene barsScene(int count, double width) {
    Scene scene = groundScene(256);
    for (int i = 0; i < count; ++i)
        scene.objects.push_back(object(box({width, 0.1, 2}), {0.13 + 2 * width * (i - 0.5 * count), 1.1, 0.21}, 5));
    return scene;
}

TEST(SmSilhouette, FailsWhereTwoEdgesShareATexel) {
    // At 128² a texel is about 0.1 m wide at the slab.
    const double broad = mismatchOn(1, barsScene(2, 0.8), "sm-silhouette:map=128", slabTop) /
                         mismatchOn(1, barsScene(2, 0.8), "sm-uniform:map=128", slabTop);
    const double thin = mismatchOn(1, barsScene(20, 0.05), "sm-silhouette:map=128", slabTop) /
                        mismatchOn(1, barsScene(20, 0.05), "sm-uniform:map=128", slabTop);
    EXPECT_LT(broad, 0.15);
    EXPECT_GT(thin, 0.5);
}

TEST(SmSilhouette, OutlinesThatTheLightDoesNotSeeAreLeftOut) {
    constexpr float plateTop = 1.049F;
    // A plate with the shadow of a box on it, and bars under the plate, whose edges are drawn last.
    Scene scene = groundScene(256);
    scene.objects.push_back(object(box({4, 0.1, 4}), {0.13, 1, 0.21}));
    scene.objects.push_back(object(box({0.8, 0.4, 0.6}), {0.13, 1.9, 0.21}, 15));
    const double alone = mismatchOn(2, scene, "sm-silhouette:map=128", plateTop);
    for (int i = 0; i < 12; ++i) scene.objects.push_back(object(box({0.07, 0.1, 2}), {-0.7 + 0.13 * i, 0.7, 0.21}, -5));
    EXPECT_EQ(mismatchOn(2, scene, "sm-silhouette:map=128", plateTop), alone);
}

// Course, "Optimizations": silhouette pixels are about one in a hundred. They are the ones whose four tests disagree, hence
// those that 2×2 percentage-closer filtering leaves grey.
TEST(SmSilhouette, SplitsTheTexelOfAtMostThreeInAHundredPixels) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "pcf:kernel=2,map=512,factor=2");
    const auto grey = std::count_if(v.begin(), v.end(), [](float x) { return x > 0 && x < 1; });
    EXPECT_GT(grey, 0);
    EXPECT_LE(static_cast<double>(grey), 0.03 * static_cast<double>(v.size()));
}

} // namespace
} // namespace shadowbench
