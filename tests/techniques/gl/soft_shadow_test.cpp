// Soft-shadow techniques under a half-plane: the penumbra of a rectangle parallel to the edge is linear.
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "tests/support/models/temporal_soft.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

double rmsOf(Stage& stage, const std::string& variant, int frames = 1) {
    return rmsError(slabPoints(stage, rendered(stage, variant, frames)));
}

double widthOf(Stage& stage, const std::string& variant, double low, double high) {
    return widthBetween(slabPoints(stage, rendered(stage, variant)), low, high);
}

TEST(SampledMaps, ThePenumbraUnderAHalfPlaneIsLinear) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    // 256 samples step by 0.004; the rest is left to the map's texels.
    EXPECT_LT(rmsOf(stage, "sampled-maps:n=256"), 0.01);
}

TEST(SampledMaps, ErrorFallsWithTheNumberOfSamples) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const double four = rmsOf(stage, "sampled-maps:n=4");
    const double sixteen = rmsOf(stage, "sampled-maps:n=16");
    const double sixtyFour = rmsOf(stage, "sampled-maps:n=64");
    EXPECT_LT(sixteen, 0.4 * four); // regular in x, across the edge: 1/n until the texels' own error shows
    EXPECT_LT(sixtyFour, 0.7 * sixteen);
}

TEST(SampledMaps, NSamplesGiveNPlusOneValues) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "sampled-maps:n=5");
    for (const float x : v) EXPECT_NEAR(5 * x, std::round(5 * x), 1e-5);
    EXPECT_EQ(figuresOf(stage, "sampled-maps:n=5").at("levels"), 4); // N − 1 between umbra and light
}

TEST(Pcss, PenumbraUnderAParallelBlockerHasTheWidthOfSimilarTriangles) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const double truth = 1.5 * 2 / 4; // light size · (receiver − blocker) / blocker
    EXPECT_NEAR(rmsOf(stage, "pcss:taps=32+32"), 0, 0.06);
    // 32 taps give steps of 1/32 or more: the inner 60 % of the ramp is known to a tenth.
    EXPECT_NEAR(widthOf(stage, "pcss:taps=32+32", 0.2, 0.8), 0.6 * truth, 0.1 * truth);
}

TEST(Pcss, HardensAtContact) {
    Scene near = halfPlaneScene();
    near.objects[1] = object(box({20, 0.002, 40}), {10.3, 0.501, 0});
    const Scene far = halfPlaneScene();
    Stage nearStage(near), farStage(far);
    nearStage.show(0);
    farStage.show(0);
    EXPECT_LT(widthOf(nearStage, "pcss", 0.05, 0.95), 0.4 * widthOf(farStage, "pcss", 0.05, 0.95));
}

TEST(TemporalSoft, ConvergesToTheTruthWhileTheCameraStandsStill) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    // The display filter is switched off (threshold 1) so that the estimator itself is measured.
    const double ten = rmsOf(stage, "temporal-soft:threshold=1", 10);
    const double sixty = rmsOf(stage, "temporal-soft:threshold=1", 60);
    const double many = rmsOf(stage, "temporal-soft:threshold=1", 250);
    EXPECT_LT(sixty, 0.5 * ten);
    EXPECT_LT(many, sixty);
    EXPECT_LT(many, 0.015);
}

TEST(TemporalSoft, TheSecondFrameIsTheMeanOfTwoSamples) { // eq. 4.5, the shader against its model
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const techniques::Variant plain = techniques::parseVariant("temporal-soft:start=0,threshold=1");
    const auto technique = plain.entry->make(plain.parameters);
    const auto frame = [&](int index, bool fresh) {
        if (fresh) technique->reset();
        stage.render(*technique, index, 1);
        return stage.visibility();
    };
    const Image<float> second = frame(1, true), first = frame(0, true), both = frame(1, false);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        EXPECT_NEAR(1 - both[i], models::occlusionUpdate(1 - first[i], 1, 1 - second[i]), 1e-3); // 16-bit sums
        differing += first[i] != second[i] ? 1 : 0;
    }
    EXPECT_GT(differing, 200U); // the two samples see different edges
}

TEST(TemporalSoft, StartsFromPcss) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_LT(rmsOf(stage, "temporal-soft", 1), 0.6 * rmsOf(stage, "temporal-soft:start=0,threshold=1"));
}

TEST(TemporalSoft, TheDisplayFilterSmoothsTheFirstFramesOnly) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_LT(rmsOf(stage, "temporal-soft:start=0", 3), rmsOf(stage, "temporal-soft:start=0,threshold=1", 3));
}

TEST(TemporalSoft, AMovingCastersShadowIsTakenAnewEachFrame) {
    Scene scene = halfPlaneScene();
    scene.timeline = {4, 30};
    scene.objects[1].motion.shift.keys = {{0, {0, 0, 0}},
                                          {30, {-1.2, 0, 0}}}; // 4 cm a frame, the edge at x = −0.9 at the end
    Stage stage(scene);
    const techniques::Variant variant = techniques::parseVariant("temporal-soft");
    const auto technique = variant.entry->make(variant.parameters);
    for (int frame = 0; frame < scene.timeline.frames(); ++frame) {
        stage.show(frame);
        stage.render(*technique, frame, 1);
    }
    const Image<float> v = stage.visibility();
    const metrics::Drawn drawn = stage.drawn();
    double umbra = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const double x = drawn.position[i].x;
        // Umbra now (its border lies at x = −0.9 − (0.85 + 0.9) / 2 … left of −0.5), lit when the motion began.
        if (drawn.id[i] != 1 || x < -0.35 || x > -0.1) continue;
        umbra += v[i];
        ++count;
    }
    ASSERT_GT(count, 100U);
    EXPECT_LT(umbra / static_cast<double>(count), 0.1);
}

} // namespace
} // namespace shadowbench
