// Depth maps that differ in what they store or in how they are fitted, on scenes whose shadow is a known polygon.
#include "tests/support/ground_score.h"
#include "tests/support/technique_folders.h"

#include <gtest/gtest.h>
#include <vector>

namespace shadowbench {
namespace {

/// The box scene under a slanting light: slanting enough for acne, but no texel of a 256² map spans more depth than half the
/// thickness of slab or box.
Scene slantedScene() {
    Scene scene = boxScene(256);
    scene.light.centre = {9.5, 3.5, -8.3};
    return scene;
}

/// A slab 3 m thick under a sheet (an open mesh) 1 m above it.
Scene sheetScene() {
    Scene scene = groundScene(256);
    scene.objects[0] = object(box({12, 3, 12}), {0, -1.5, 0});
    scene.objects.push_back(object(plane(0.7), {0.13, 1.0, 0.21}));
    return scene;
}

TEST(SmMidpoint, HasNoAcneWithoutBiasWhereAUniformMapHas) {
    const Scene scene = slantedScene();
    Stage stage(scene);
    stage.show(0);
    // At the slab's rim the second surface is its side, close behind the first: hence not exactly zero.
    EXPECT_LE(scoreOnGround(scene, stage, rendered(stage, "sm-midpoint:map=256"), 4).falseShadow, 0.002);
    EXPECT_GT(scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=256,bias=none"), 4).falseShadow, 0.05);
}

TEST(SmMidpoint, AveragesAtTheLookupToWhatAMapOfMeansHolds) {
    const Scene scene = slantedScene();
    Stage stage(scene);
    stage.show(0);
    const std::string toml = R"(id = "means"
title = "A map of means"
answer = "hard"
target.firstDepth = { format = "Depth32F", size = 256 }
target.secondDepth = { format = "R32F", size = 256 }
target.depthMap = { format = "Depth32F", size = 256, compare = true }
pass = [
    { name = "first", draw = "casters", to = "firstDepth" },
    { name = "second", draw = "casters", to = ["secondDepth", "firstDepth"], peel = true, blend = "min", clear = [1, 1, 1, 1], fragment = "shared/maps/midpoint_peel.frag" },
    { name = "means", draw = "screen", fragment = "shared/maps/midpoint_mean.frag", to = "depthMap" },
    { name = "resolve", draw = "screen", fragment = "shared/maps/single_map.frag", to = "visibility" },
]
)";
    const auto means = WrittenTechnique(toml).made();
    stage.render(*means, 0, 1);
    const Image<float> expected = stage.visibility();
    EXPECT_EQ(differing(rendered(stage, "sm-midpoint:map=256"), expected), 0U);
}

TEST(SmMidpoint, FrontAndBackFacesGiveTheSameOnClosedMeshesThatDoNotMeet) {
    const Scene scene = slantedScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> surface = rendered(stage, "sm-midpoint:map=256");
    const Image<float> faces = rendered(stage, "sm-midpoint:map=256,second=backface");
    std::size_t differing = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) differing += surface[i] != faces[i] ? 1 : 0;
    EXPECT_LE(differing,
              surface.size() / 1000); // texels at an outline, where one layer's texel is hit and the other's missed
}

TEST(SmMidpoint, LosesTheShadowOfAnOpenMeshWhereFrontIsAveragedWithBackFaces) { // Zápotocký 4.4.2, remark
    const Scene scene = sheetScene();
    Stage stage(scene);
    stage.show(0);
    const auto shadow = [&](const std::string& variant) {
        const Image<float> v = rendered(stage, variant);
        const metrics::Drawn drawn = stage.drawn();
        std::size_t dark = 0;
        for (std::size_t i = 0; i < v.size(); ++i) dark += drawn.id[i] == 1 && drawn.position[i].y > -0.001F && v[i] < 0.5F;
        return static_cast<double>(dark);
    };
    const double truth = shadow("volume-zfail");
    ASSERT_GT(truth, 500);
    EXPECT_NEAR(shadow("sm-uniform"), truth, 0.05 * truth);
    EXPECT_NEAR(shadow("sm-midpoint"), truth, 0.05 * truth); // the sheet and the slab's top: the mean lies between them
    EXPECT_LT(shadow("sm-midpoint:second=backface"), 0.05 * truth); // the sheet and the slab's bottom: below the slab's top
}

/// The box scene in the sun, with much slab around it that the camera does not see.
Scene wideScene() {
    Scene scene = boxScene(256);
    scene.objects[0] = object(box({60, 0.2, 60}), {0, -0.1, 0});
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(-0.3, -1, 0.4)), {}, {}};
    scene.light.centre = -1e6 * scene.light.direction; // for the closed form
    return scene;
}

TEST(SmFocused, IsBetterThanAUniformMapOfTheSameSize) {
    const Scene scene = wideScene();
    Stage stage(scene);
    stage.show(0);
    const double uniform = scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=512"), 0).mismatch;
    const double focused = scoreOnGround(scene, stage, rendered(stage, "sm-focused:map=512"), 0).mismatch;
    EXPECT_LT(focused, 0.5 * uniform); // the camera sees less than a third of the slab's width
}

TEST(SmFocused, FlickersWhenTheCameraMoves) {
    const Scene scene = wideScene();
    /// Labels of a grid of points around the shadow, as seen by a camera moved sideways.
    const auto labels = [&](const std::string& variant, double shift) {
        Scene moved = scene;
        moved.camera.eye.x += shift;
        moved.camera.target.x += shift;
        Stage stage(moved);
        stage.show(0);
        const Image<float> v = rendered(stage, variant);
        const metrics::Drawn drawn = stage.drawn();
        std::vector<float> result;
        for (double x = -2; x <= 2; x += 0.02)
            for (double z = -1; z <= 3; z += 0.02) {
                const glm::dvec3 at = moved.camera.project({x, 0, z}, moved.size);
                const int px = static_cast<int>(at.x), py = static_cast<int>(at.y);
                result.push_back(drawn.id(px, py) == 1 ? v(px, py) : -1);
            }
        return result;
    };
    const auto changes = [&](const std::string& variant) {
        const auto a = labels(variant, 0), b = labels(variant, 0.07); // half a texel of the focused map
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) count += a[i] >= 0 && b[i] >= 0 && a[i] != b[i] ? 1 : 0;
        return count;
    };
    // Maps with texels of about the same size. The uniform map's stay where they are: what changes there is which points
    // fall into one pixel, as with shadow volumes.
    const std::size_t focused = changes("sm-focused:map=128");
    EXPECT_GT(focused, 2 * changes("sm-uniform:map=512"));
    EXPECT_GT(focused, 2 * changes("volume-zfail"));
}

} // namespace
} // namespace shadowbench
