// Shadow silhouette maps: exact on straight edges, wrong where two edges share a texel.
#include "scene/load/load.h"
#include "tests/support/ground_score.h"

#include <algorithm>
#include <glm/geometric.hpp>
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

/// Pixels that show a surface, and those of them that face the light of the scene.
struct Shown {
    double seen = 0, facing = 0;
};

Shown shown(const Scene& scene, const Stage& stage) {
    const metrics::Drawn drawn = stage.drawn();
    const Image<glm::vec3> normals = stage.normals();
    const glm::dvec4 light = scene.light.centreOnly().homogeneous();
    Shown count;
    for (std::size_t i = 0; i < drawn.id.size(); ++i) {
        if (drawn.id[i] == 0) continue;
        const glm::dvec3 toLight = glm::dvec3(light) - light.w * glm::dvec3(drawn.position[i]);
        ++count.seen;
        if (glm::dot(glm::dvec3(normals[i]), toLight) > 0) ++count.facing;
    }
    return count;
}

double pixelsOfTheBranch(const std::map<std::string, double>& figures, const Shown& pixels) {
    return figures.at("silhouette_branch") * pixels.facing + figures.at("averted_branch") * (pixels.seen - pixels.facing);
}

// The pixels of the branch are those whose four tests differ, hence those that 2×2 percentage-closer filtering leaves grey;
// a few read a texel's very centre.
TEST(SmSilhouette, CountsThePixelsThatFilteringLeavesGrey) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "pcf:kernel=2,map=512,factor=2");
    const auto grey = static_cast<double>(std::count_if(v.begin(), v.end(), [](float x) { return x > 0 && x < 1; }));
    EXPECT_GT(grey, 100);
    EXPECT_NEAR(pixelsOfTheBranch(figuresOf(stage, "sm-silhouette:map=512"), shown(scene, stage)), grey, 0.02 * grey);
}

// Course, "Optimizations": silhouette pixels are about one in a hundred of the image, here of those that face the light.
// Twice the texels per side make the edges half as wide.
TEST(SmSilhouette, TakesItsBranchInAtMostThreeInAHundredPixelsOfTheBasicScene) {
    testContext();
    const Scene scene = loadScene("basic", Profile::Standard);
    ASSERT_EQ(scene.size, glm::ivec2(512));
    Stage stage(scene);
    stage.show(0);
    const double coarse = figuresOf(stage, "sm-silhouette:map=512").at("silhouette_branch");
    const double fine = figuresOf(stage, "sm-silhouette:map=1024").at("silhouette_branch");
    EXPECT_LE(coarse, 0.03);
    EXPECT_NEAR(fine, 0.5 * coarse, 0.1 * coarse);
}

TEST(SmSilhouette, CountsItsBytesWithoutATrace) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> untouched = rendered(stage, "sm-silhouette:map=128");
    const auto small = figuresOf(stage, "sm-silhouette:map=128"), large = figuresOf(stage, "sm-silhouette:map=512");
    EXPECT_EQ(rendered(stage, "sm-silhouette:map=128"), untouched);
    EXPECT_EQ(figuresOf(stage, "sm-silhouette:map=128"), small);
    // Slab, box and their backs cover the map: 16 times the texels are 16 times the depths; outlines grow by 4 only.
    EXPECT_GT(large.at("map_bytes"), 12 * small.at("map_bytes"));
    EXPECT_LT(large.at("map_bytes"), 16 * small.at("map_bytes"));
    // Four depths of 4 bytes for each pixel that shows something, five points of 4 for those of the branch.
    const Shown pixels = shown(scene, stage);
    EXPECT_NEAR(small.at("lookup_bytes"), 16 * pixels.seen + 20 * pixelsOfTheBranch(small, pixels), 1);
}

} // namespace
} // namespace shadowbench
