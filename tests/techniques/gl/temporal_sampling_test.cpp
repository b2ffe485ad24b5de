// One light sample a frame, averaged: n still frames are the mean of n maps.
#include "tests/support/rows_over_frames.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(TemporalSampling, NStillFramesAreTheMeanOfNMaps) { // eq. 4.5 against eq. 4.2, from the same Halton points
    Scene scene = halfPlaneScene();
    scene.objects[1] = object(box({1.6, 0.4, 1.2}), {0.13, 2, 0.21}); // both coordinates of a sample count
    Stage stage(scene);
    stage.show(0);
    for (const int n : {1, 2, 9}) {
        const Image<float> summed = rendered(stage, "temporal-sampling", n);
        const Image<float> mean = rendered(stage, "sampled-maps:pattern=halton,n=" + std::to_string(n));
        double worst = 0;
        for (std::size_t i = 0; i < mean.size(); ++i)
            worst = std::max(worst, std::abs(static_cast<double>(summed[i]) - static_cast<double>(mean[i])));
        EXPECT_LT(worst, 1e-3) << n; // 16-bit sums
    }
}

TEST(TemporalSampling, ConvergesToTheTruthWhileTheCameraStandsStill) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const double ten = rmsError(slabPoints(stage, rendered(stage, "temporal-sampling", 10)));
    const double many = rmsError(slabPoints(stage, rendered(stage, "temporal-sampling", 250)));
    EXPECT_LT(many, 0.3 * ten);
    EXPECT_LT(many, 0.015);
}

TEST(TemporalSampling, AnAbsoluteDepthTestRejectsWhat16BitsHaveRounded) { // eq. 4.4 against 4.8
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto reused = [&](const std::string& parameters) {
        const techniques::Variant variant = techniques::parseVariant("temporal-sampling:" + parameters);
        const auto technique = variant.entry->make(variant.parameters);
        for (int frame = 0; frame < 3; ++frame) stage.render(*technique, frame, 1);
        return technique->figures(stage.frame(2, 1)).at("reused");
    };
    EXPECT_EQ(reused("epsilon=0.002"), 1);                       // the camera stands still: everything was there before
    EXPECT_LT(reused("depth-test=absolute,epsilon=0.001"), 0.8); // from 4 m on 16-bit depths are 2 to 4 mm apart
    EXPECT_EQ(reused("depth-test=absolute,epsilon=0.01"), 1);
}

TEST(TemporalSampling, BothBuffersAreFivePercentWiderAndHigherThanTheImage) { // 4.2: 840×630 for 800×600
    Scene scene = halfPlaneScene();
    scene.size = {160, 120};
    Stage stage(scene);
    stage.show(0);
    constexpr double bytes = 2 * 4 * 2; // two buffers of four channels of 16 bits
    EXPECT_NEAR(figuresOf(stage, "temporal-sampling").at("shadow_buffer_bytes"), bytes * 168 * 126 / (160 * 120), 1e-9);
}

TEST(TemporalSampling, TheSecondFrameHasStepsOfAHalf) { // what the source admits
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> first = rendered(stage, "temporal-sampling", 1), second = rendered(stage, "temporal-sampling", 2);
    int halves = 0, jumps = 0;
    for (std::size_t i = 0; i < second.size(); ++i) {
        EXPECT_NEAR(first[i], std::round(first[i]), 1e-3);
        EXPECT_NEAR(2 * second[i], std::round(2 * second[i]), 2e-3);
        halves += std::abs(second[i] - 0.5F) < 1e-3F ? 1 : 0;
        jumps += std::abs(second[i] - first[i]) > 0.49F ? 1 : 0;
    }
    EXPECT_GT(halves, 200); // between the edges of the two samples
    EXPECT_EQ(jumps, halves);
}

/// The plate of the half-plane moves 4 cm a frame for 30 frames; what the slab shows after them, between where its umbra
/// was and where it has come to.
double visibilityInAMovedUmbra(const std::string& variant) {
    Scene scene = halfPlaneScene();
    scene.timeline = {4, 30};
    scene.objects[1].motion.shift.keys = {{0, {0, 0, 0}}, {30, {-1.2, 0, 0}}};
    Stage stage(scene);
    const techniques::Variant parsed = techniques::parseVariant(variant);
    const auto technique = parsed.entry->make(parsed.parameters);
    for (int frame = 0; frame < scene.timeline.frames(); ++frame) {
        stage.show(frame);
        stage.render(*technique, frame, 1);
    }
    return visibilityAt(slabPoints(stage, stage.visibility()), -0.2, 0.15);
}

TEST(TemporalSampling, DragsTrailsBehindWhatMoves) {              // 4.1.4 is temporal-soft's
    EXPECT_GT(visibilityInAMovedUmbra("temporal-sampling"), 0.3); // many of its frames were lit there
    EXPECT_LT(visibilityInAMovedUmbra("temporal-soft"), 0.1);
}

/// What the last frame of a scene's timeline shows.
Image<float> afterAllFrames(const Scene& scene, Stage& stage, const std::string& variant = "temporal-sampling") {
    const auto row = rowOf(variant);
    for (int frame = 0; frame < scene.timeline.frames(); ++frame) {
        stage.show(frame);
        stage.render(*row, frame, 1);
    }
    return stage.visibility();
}

TEST(TemporalSampling, KeepsItsHistoryWhileTheCameraMoves) {
    Scene scene = halfPlaneScene();
    scene.timeline = {20, 20};
    // 8 cm a frame, mostly forwards: more than epsilon of the distance, were it not for the camera that moves.
    scene.eye.keys = {{0, scene.camera.eye}, {20, scene.camera.eye + glm::dvec3(0.4, -0.8, -1.3)}};
    Stage stage(scene);
    const double kept = rmsError(slabPoints(stage, afterAllFrames(scene, stage)));
    const double anew = rmsError(slabPoints(stage, rendered(stage, "temporal-sampling", 1)));
    EXPECT_LT(kept, 0.2 * anew);
}

TEST(TemporalSoft, SmoothsAsWidelyWhereTheCameraComesNearer) { // eq. 4.8 asks for depths of one frame
    Scene standing = halfPlaneScene();
    standing.timeline = {9, 1}; // few samples: smoothed
    Scene nearing = standing;
    const glm::dvec3 eye = standing.camera.eye, target = standing.camera.target;
    nearing.eye.keys = {{0, target + 1.05 * (eye - target)}, {1, eye}}; // by more than epsilon of each distance
    Stage stage(standing), moving(nearing);
    const Image<float> smoothed = afterAllFrames(standing, stage, "temporal-soft"),
                       plain = afterAllFrames(standing, stage, "temporal-soft:threshold=1"),
                       after = afterAllFrames(nearing, moving, "temporal-soft");
    EXPECT_LT(rmsDifference(after, smoothed), rmsDifference(smoothed, plain));
}

TEST(TemporalSampling, BeginsAnewWhatAPlateHasHidden) { // eq. 4.8
    Scene scene = halfPlaneScene();
    scene.objects.push_back(object(box({0.3, 0.002, 0.3}), {-0.45, 1.55, 2.3})); // lit, before the penumbra
    scene.timeline = {16, 1};
    scene.eye.keys = {{0, scene.camera.eye}, {1, scene.camera.eye + glm::dvec3(0.3, 0, 0)}};
    Stage stage(scene);
    int dark = 0, graded = 0;
    for (const SlabPoint& point : slabPoints(stage, afterAllFrames(scene, stage))) {
        if (std::abs(point.truth - 0.5) > 0.2) continue; // of 17 samples there, some are lit
        if (point.visibility < 1e-3)
            ++dark; // by its first sample, though the plate was lit
        else if (point.visibility < 1 - 1e-3)
            ++graded;
    }
    EXPECT_GT(dark, 20);
    EXPECT_GT(graded, 100);
}

} // namespace
} // namespace shadowbench
