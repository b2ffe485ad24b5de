// Convolution shadow maps against the Fourier step.
#include "techniques/filtered/csm-fourier/csm-fourier.h"
#include "techniques/filtered/prefiltered_map.h"
#include "tests/support/filtered_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace techniques;

constexpr double shownOffset = 0.5; // the parameter's default

/// What the technique has to give at a ground point fully behind one occluder `gap` of the depth range away.
double behind(double gap, int terms, double damping) {
    const double offset = 0.5 * shownOffset / terms;
    return std::clamp(litGain(terms, damping, offset) * fourierStep(offset - usedDepth(terms) * gap, terms, damping), 0.0,
                      1.0);
}

/// Mean visibility of the ground well behind the plate's edge.
double inShadow(Stage& stage, const std::string& variant) {
    double sum = 0, count = 0;
    for (const GroundPoint& point : groundPoints(stage, rendered(stage, variant)))
        if (point.at.x > edgeAt + 0.4) {
            sum += point.visibility;
            ++count;
        }
    return sum / count;
}

TEST(CsmFourier, ShadowsAreAsDarkAsTheSeries) {
    for (const double height : {1.2, 2.1, 5.0}) {
        Scene scene = edgeScene(height, 96);
        scene.objects.push_back(object(box({0.2, 0.2, 0.2}), {-5.5, 7.9, -5.5})); // the same depth range for all
        Stage stage(scene);
        stage.show(0);
        const double gap = (height + 0.1) / 8.2;
        for (const int terms : {4, 16})
            for (const double damping : {0.0, 1.0}) // 8-bit means move the sum by a hundredth or two
                EXPECT_NEAR(inShadow(stage, fmt::format("csm-fourier:map=256,terms={},damping={}", terms, damping)),
                            behind(gap, terms, damping), 0.02)
                    << height << " m, " << terms << " terms, damping " << damping;
    }
}

TEST(CsmFourier, FewTermsRing) { // what the paper admits: shadows brighten and darken with the occluder's distance
    const auto ringing = [](int terms) {
        double most = 0;
        for (double gap = 1.0 / 4; gap < 0.9; gap += 0.001) most = std::max(most, behind(gap, terms, 0));
        return most;
    };
    ASSERT_GT(ringing(4), 2 * ringing(32));
    double distance = 0; // of the brightest spot of 4 terms
    for (double gap = 1.0 / 4; gap < 0.9; gap += 0.001)
        if (behind(gap, 4, 0) == ringing(4)) distance = gap;
    Scene scene = edgeScene(8.2 * distance - 0.1, 96);
    scene.objects.push_back(object(box({0.2, 0.2, 0.2}), {-5.5, 7.9, -5.5}));
    Stage stage(scene);
    stage.show(0);
    const double few = inShadow(stage, "csm-fourier:map=256,terms=4,damping=0");
    EXPECT_GT(few, 0.03);
    EXPECT_LT(inShadow(stage, "csm-fourier:map=256,terms=16"), 0.5 * few);
}

TEST(CsmFourier, ASecondOccluderDoesNotLeak) {
    const Scene scene = stackedScene(1.5, 5);
    Stage stage(scene);
    stage.show(0);
    EXPECT_LT(brightest(groundPoints(stage, rendered(stage, "csm-fourier:map=256"))),
              0.2 * brightest(groundPoints(stage, rendered(stage, "vsm:map=256"))));
}

TEST(CsmFourier, AnEdgeIsARampOfTheKernelsWidth) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const auto points = groundPoints(stage, rendered(stage, "csm-fourier:map=256"));
    // The gain, which clips the ramp's lit end, and 8 bits.
    const double clipped = 1 - 1 / litGain(16, 1, 0.5 * shownOffset / 16);
    EXPECT_LT(fromRamp(points, 7 * texelOf(scene, 256 - 2 * freeRim(boxFilter(7)))), clipped + 0.03);
}

TEST(CsmFourier, AnOccluderWithinTheStepsWidthIsTransparent) {
    Scene scene = edgeScene(1.2, 96);
    scene.objects.push_back(object(box({0.2, 0.2, 0.2}), {-5.5, 29.9, -5.5})); // stretches the depth range
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(inShadow(stage, "csm-fourier:map=256,terms=4"), 0.8); // 1/23 of the range, the step takes 1/8
    EXPECT_LT(inShadow(stage, "csm-fourier:map=256,terms=32,damping=0"), 0.1);
}

// Gibbs: with offset=1 a lit surface is tested 1/(2M) of the depth range before itself, where the undamped series has its
// greatest overshoot, 9 % whatever the number of terms. 8-bit means move the sum by a hundredth or two.
TEST(CsmFourier, TellsTheSeriesOvershoot) {
    const Scene scene = edgeScene(2.1, 96);
    Stage stage(scene);
    stage.show(0);
    for (const int terms : {4, 8, 16}) {
        const double expected = fourierStep(0.5 / terms, terms, 0) - 1;
        EXPECT_GT(expected, 0.085);
        const auto figures = figuresOf(stage, fmt::format("csm-fourier:offset=1,terms={},damping=0", terms));
        EXPECT_NEAR(figures.at("overshoot"), expected, 0.02) << terms;
        EXPECT_GT(figures.at("ringing"), 0) << terms;
        EXPECT_LT(figures.at("ringing"), figures.at("overshoot")) << terms;
        EXPECT_LT(figuresOf(stage, fmt::format("csm-fourier:terms={}", terms)).at("overshoot"), 0.02) << terms; // damped
    }
}

} // namespace
} // namespace shadowbench
