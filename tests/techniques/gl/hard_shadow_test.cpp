// Hard-shadow techniques on scenes whose shadow is a known polygon.
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/sampling/sampling.h"
#include "tests/support/ground_score.h"
#include "tests/support/models/sm_history.h"
#include "tests/support/stages.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(VolumeZfail, ABoxsShadowIsTheExactPolygonToATwentiethOfAPixel) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "volume-zfail"), 0.05).mismatch, 0);
}

TEST(VolumeZfail, TheFarPlaneAtInfinityGivesTheSameImageAsClampedDepth) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const Image<float> clamped = rendered(stage, "volume-zfail"), infinite = rendered(stage, "volume-zfail:far=infinity");
    std::size_t differing = 0;
    for (std::size_t i = 0; i < clamped.size(); ++i) differing += clamped[i] != infinite[i] ? 1 : 0;
    EXPECT_LE(differing, 3U); // depth is rounded differently; only pixels on an edge can tell
}

TEST(VolumeZfail, HoldsWithTheEyeInsideTheShadow) {
    Scene scene = boxScene(128);
    scene.light.centre = {0.13, 9, 0.21};
    scene.camera.eye = {0.2, 0.6, 0.3}; // between slab and box
    scene.camera.target = {2.5, 0, 0.4};
    scene.camera.near = 0.01;
    Stage stage(scene);
    stage.show(0);
    const BoxScore score = scoreOnGround(scene, stage, rendered(stage, "volume-zfail"), 0.05);
    EXPECT_EQ(score.mismatch, 0);
}

TEST(VolumeZfail, EndsShadowsOfADirectionalLightInAPoint) {
    Scene scene = boxScene(128);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(-0.3, -1, 0.4));
    scene.light = {LightKind::Directional, {}, direction, {}, {}};
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "volume-zfail");
    scene.light.centre = -1e6 * direction; // for the closed form
    EXPECT_EQ(scoreOnGround(scene, stage, v, 0.05).mismatch, 0);
}

TEST(SmUniform, ErrorAtLeastHalvesFromMap512To2048) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const double coarse = scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=512"), 0).mismatch;
    const double fine = scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=2048"), 0).mismatch;
    EXPECT_GT(coarse, 0);
    EXPECT_LE(fine, 0.5 * coarse);
}

TEST(SmUniform, HasAcneWithoutBiasAndNoneWithSlopeBias) {
    Scene scene = boxScene(256);
    scene.light.centre = {5.5, 1.5, -4.3}; // grazes the slab
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=256,bias=none"), 2).falseShadow, 0.05);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=256"), 2).falseShadow, 0);
}

TEST(SmUniform, AHugeConstantBiasLosesTheShadow) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(scoreOnGround(scene, stage, rendered(stage, "sm-uniform:bias=constant,units=8000000"), 1).leak, 0.9);
}

TEST(SmLispsm, IsRightAwayFromEdges) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    // A texel of the 1024² map is well below two pixels here.
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-lispsm"), 2).mismatch, 0);
}

TEST(SmHistory, SharpensACoarseMapWhileTheCameraStandsStill) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const double base = scoreOnGround(scene, stage, rendered(stage, "sm-uniform:map=128"), 0).mismatch;
    const double early = scoreOnGround(scene, stage, rendered(stage, "sm-history:base=uniform,map=128", 10), 0).mismatch;
    const double late = scoreOnGround(scene, stage, rendered(stage, "sm-history:base=uniform,map=128", 60), 0).mismatch;
    EXPECT_LT(early, base);
    EXPECT_LT(late, early);
    EXPECT_LT(late, 0.25 * base); // the estimator on straight edges leaves 0.16
}

TEST(SmHistory, LearnsNothingFromTheSameRasterisationAgain) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const double without =
        scoreOnGround(scene, stage, rendered(stage, "sm-history:base=uniform,map=128,jitter=none", 60), 0).mismatch;
    const double with = scoreOnGround(scene, stage, rendered(stage, "sm-history:base=uniform,map=128", 60), 0).mismatch;
    EXPECT_GT(without, 3 * with);
}

TEST(SmHistory,
     ASecondFrameIsWeightedByTheConfidenceOfItsSample) { // eq. 3.3, 3.6, 3.7: the shader against its model
    const Scene scene = boxScene(128);
    Stage stage(scene);
    stage.show(0);
    const auto twoFrames = [&](const std::string& m) {
        return rendered(stage, "sm-history:base=uniform,map=64,step=0,m=" + m, 2);
    };
    const Image<float> first = rendered(stage, "sm-history:base=uniform,map=64,step=0,m=3");
    const Image<float> current = twoFrames("0"); // weight 1: this frame's test alone
    const Image<float> both = twoFrames("3");

    // The second frame's rasterisation, as the technique draws it.
    using namespace techniques;
    const LightView view = jittered(fitToScene(scene.light, stage.shown()), glm::two_pi<double>() * haltonOf(1, 1, 5),
                                    {haltonOf(1, 1, 2) - 0.5, haltonOf(1, 1, 3) - 0.5}, 64);
    const metrics::Drawn drawn = stage.drawn();
    std::size_t weighted = 0;
    for (std::size_t pixel = 0; pixel < both.size(); ++pixel) {
        if (drawn.id[pixel] == 0) continue;
        const glm::dvec4 h = view.clipFromWorld * glm::dvec4(drawn.position[pixel], 1);
        const double sure = models::confidence(64.0 * (0.5 * glm::dvec2(h) / h.w + 0.5));
        EXPECT_NEAR(both[pixel], models::smoothed(first[pixel], current[pixel], sure, 3),
                    2e-3); // 16-bit history, 32-bit map position
        weighted += first[pixel] != current[pixel] ? 1 : 0;
    }
    EXPECT_GT(weighted, 100U); // pixels where the weight shows
}

TEST(SmHistory, ForgetsOnReset) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const techniques::Variant variant = techniques::parseVariant("sm-history");
    const auto technique = variant.entry->make(variant.parameters);
    stage.render(*technique, 0, 1);
    const Image<float> first = stage.visibility();
    for (int frame = 1; frame < 5; ++frame) stage.render(*technique, frame, 1);
    EXPECT_NE(stage.visibility(), first);
    technique->reset();
    stage.render(*technique, 0, 1);
    EXPECT_EQ(stage.visibility(), first);
}

TEST(Pcf, BilinearAndWiderKernelsSmoothTheEdgeWithoutMovingIt) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    std::size_t grey = 0;
    for (const char* variant : {"pcf:kernel=2", "pcf", "pcf:kernel=7"}) {
        const Image<float> v = rendered(stage, variant);
        EXPECT_EQ(scoreOnGround(scene, stage, v, 5).mismatch, 0) << variant;
        const auto now = static_cast<std::size_t>(std::count_if(v.begin(), v.end(), [](float x) { return x > 0 && x < 1; }));
        EXPECT_GT(now, grey) << variant;
        grey = now;
    }
}

TEST(Pcf, MidpointDepthNeedsNoBiasOnClosedMeshes) {
    Scene scene = boxScene(256);
    scene.light.centre = {9.5, 3.5, -8.3}; // slanting, but no texel spans more depth than half the slab's thickness
    Stage stage(scene);
    stage.show(0);
    // At the slab's rim the second surface is its side, close behind the first.
    EXPECT_LT(scoreOnGround(scene, stage, rendered(stage, "pcf:kernel=2,depth=midpoint,bias=none,map=256"), 4).falseShadow,
              0.002);
    EXPECT_GT(scoreOnGround(scene, stage, rendered(stage, "pcf:kernel=2,bias=none,map=256"), 4).falseShadow, 0.05);
}

} // namespace
} // namespace shadowbench
