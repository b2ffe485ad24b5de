// Soft shadows under temporal antialiasing: what an exponential mean leaves of noise, and what a clamp lets go.
#include "tests/support/rows_over_frames.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Accumulated, TheFirstFrameIsThatOfPcssVogel) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    for (const std::string parameters : {"", ":cascades=3"})
        EXPECT_EQ(
            rmsDifference(imageAfter(stage, "accumulated" + parameters, 1), imageAfter(stage, "pcss-vogel" + parameters, 1)),
            0);
}

TEST(Accumulated, WithoutAClampItIsTheExponentialMeanOfTheFrames) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto plain = rowOf("pcss-vogel");
    Image<float> expected = imageAfter(stage, *plain, 1);
    for (int frame = 1; frame < 12; ++frame) {
        stage.render(*plain, frame, 1);
        const Image<float> image = stage.visibility();
        for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = 0.75F * expected[i] + 0.25F * image[i];
    }
    // History is read where rounding puts the pixel's own point: a millionth of a pixel beside its centre.
    EXPECT_LT(rmsDifference(imageAfter(stage, "accumulated:clamp=none,share=0.25", 12), expected), 1e-3);
}

TEST(Accumulated, LeavesAFractionOfOneFramesNoise) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> many = meanOver(stage, *rowOf("pcss-vogel"), 64);
    const double one = rmsDifference(imageAfter(stage, "pcss-vogel", 1), many);
    // √(share / (2 − share)) = 0.23 of the noise of independent frames; those of the noise's sequence are spread more
    // evenly.
    EXPECT_LT(rmsDifference(imageAfter(stage, "accumulated:clamp=none", 60), many), 0.25 * one);
    EXPECT_LT(rmsDifference(imageAfter(stage, "accumulated", 60), many), 0.5 * one); // the clamp lets some noise back in
}

/// The plate of the half-plane jumps half a metre back: what is wrong one frame later where its umbra was and light is now.
double trail(const std::string& variant) {
    Scene scene = halfPlaneScene();
    scene.light.u.x = scene.light.v.z = 0.2;
    scene.timeline = {20, 2};
    scene.objects[1].motion.shift.keys = {{0, {0, 0, 0}}, {1, {1.2, 0, 0}}, {2, {1.2, 0, 0}}};
    Stage stage(scene);
    const auto row = rowOf(variant);
    for (int frame = 0; frame < 22; ++frame) {
        stage.show(frame);
        stage.render(*row, frame, 1);
    }
    return 1 - visibilityAt(slabPoints(stage, stage.visibility()), 0.8, 0.1);
}

TEST(Accumulated, TheClampForgetsWhatHasGone) {
    EXPECT_GT(trail("accumulated:clamp=none"), 0.7); // 0.9² of it
    EXPECT_LT(trail("accumulated"), 0.01);
}

} // namespace
} // namespace shadowbench
