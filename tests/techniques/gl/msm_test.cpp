// Moment shadow maps against their closed form: of three depths, one of which is the receiver's, four moments know the
// shares.
#include "tests/support/filtered_scenes.h"
#include "tests/support/models/vsm.h"
#include "tests/support/modern_rows.h"
#include "tests/support/shader_function.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

namespace shadowbench {
namespace {

constexpr double bias = 3e-6; // of the row in 32 bits

TEST(MsmBound, IsExactForTwoOccludersAndTheReceiver) {
    std::vector<glm::vec4> inputs;
    for (const float near : {0.1F, 0.25F})
        for (const float far : {0.4F, 0.55F})
            for (const float receiver : {0.7F, 0.95F})
                for (const float lit : {0.0F, 0.2F, 0.5F, 0.9F}) inputs.emplace_back(near, far, receiver, lit);
    const auto results = evaluated(
        "modern/msm/moments.glsl",
        fmt::format("shadowedShare(mix(mix(powersOf(x.x), powersOf(x.y), 0.3), powersOf(x.z), x.w), x.z, {:#.9g})", bias),
        inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        EXPECT_NEAR(results[i].x, 1 - inputs[i].w, 0.01) << i; // the bias, over the square of the nearest two depths
}

TEST(MsmBound, IsNeverAboveTheShareInShadowAndTighterThanChebyshevs) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<glm::vec4> inputs;
    for (int i = 0; i < 400; ++i) inputs.emplace_back(uniform(random), uniform(random), uniform(random), uniform(random));
    const std::string four = "(powersOf(x.x) + powersOf(x.y) + powersOf(x.z) + powersOf(0.5)) / 4.0";
    const auto bounds =
        evaluated("modern/msm/moments.glsl", fmt::format("shadowedShare({}, x.w, {:#.9g})", four, bias), inputs);
    double ours = 0, theirs = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::vec4& x = inputs[i];
        double before = 0;
        models::Moments moments;
        for (const float depth : {x.x, x.y, x.z, 0.5F}) {
            before += depth < x.w ? 0.25 : 0;
            moments.mean += 0.25 * depth;
            moments.meanSquare += 0.25 * depth * depth;
        }
        EXPECT_LE(bounds[i].x, before + 0.02) << i; // rounding of four powers
        ours += before - bounds[i].x;
        theirs += before - (1 - models::chebyshevBound(moments, x.w));
    }
    EXPECT_GT(ours, 0);
    EXPECT_LT(ours, 0.7 * theirs);
}

TEST(MsmQuantisation, FillsTheUnitIntervalAndIsUndone) {
    std::vector<glm::vec4> inputs;
    for (int i = 0; i <= 64; ++i) inputs.emplace_back(static_cast<float>(i) / 64, 0, 0, 0);
    const auto numbers = evaluated("modern/msm/moments.glsl", "quantised(powersOf(x.x))", inputs);
    const auto back = evaluated("modern/msm/moments.glsl", "dequantised(quantised(powersOf(x.x)))", inputs);
    glm::vec4 low(1), high(0);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        low = glm::min(low, numbers[i]);
        high = glm::max(high, numbers[i]);
        float power = 1;
        for (int j = 0; j < 4; ++j) EXPECT_NEAR(back[i][j], power *= inputs[i].x, 1e-5) << i;
    }
    for (int j = 0; j < 4; ++j) {
        EXPECT_NEAR(low[j], 0, 0.02) << j;
        EXPECT_NEAR(high[j], 1, 0.02) << j;
    }
}

TEST(Msm, AnEdgeIsARampOfTheKernelsWidth) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    for (const char* format : {"RGBA32F,bias=3e-06", "RGBA16"})
        for (const int kernel : {3, 7}) {
            const auto points = groundPoints(
                stage, renderedModern(stage, "msm", fmt::format("map=256,kernel={},format={}", kernel, format)));
            EXPECT_LT(fromRamp(points, kernel * texelOf(scene, 256)), 0.03)
                << kernel << format; // the ground's pixels are finite
        }
}

TEST(Msm, TwoOccludersHardlyLeakWhereVarianceDoes) {
    const Scene scene = stackedScene(1.5, 5);
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(brightest(groundPoints(stage, rendered(stage, "vsm:map=256"))), 0.2);
    for (const char* format : {"RGBA32F,bias=3e-06", "RGBA16"})
        EXPECT_LT(brightest(groundPoints(stage, renderedModern(stage, "msm", fmt::format("map=256,format={}", format)))),
                  0.02)
            << format;
}

TEST(Msm, ALitPlaneIsLitAtAnySlant) {
    Scene scene = groundScene(128);
    scene.light.centre = {9.5, 2.5, -8.3};
    Stage stage(scene);
    stage.show(0);
    for (const char* format : {"RGBA32F,bias=3e-06", "RGBA16"})
        for (const GroundPoint& point :
             groundPoints(stage, renderedModern(stage, "msm", fmt::format("map=256,format={}", format))))
            ASSERT_GT(point.visibility, 0.9) << format;
}

} // namespace
} // namespace shadowbench
