// Exponential variance shadow maps against their closed forms: an edge is a ramp, a second occluder leaks less the steeper
// the warp, and what lies behind the receiver lights it where the positive warp is alone.
#include "tests/support/filtered_scenes.h"
#include "tests/support/models/evsm.h"
#include "tests/support/modern_rows.h"
#include "tests/support/shader_function.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using models::Kernel;
using models::warpedBound;

constexpr double leastVariance = 2.5e-9; // the row's default

gl::Defines definesOf(const std::string& format, double positive, double negative) {
    return {{"POSITIVE", fmt::format("{:#.9g}", positive)},
            {"NEGATIVE", fmt::format("{:#.9g}", negative)},
            {"VARIANCE", fmt::format("{:#.9g}", leastVariance)},
            {"FORMAT_" + format, "1"}};
}

/// The shader's share of a kernel of which `z` is as deep as `x`, and the rest as `y`, before a receiver at `w`.
std::vector<glm::vec4> litShares(const std::vector<glm::vec4>& inputs, const gl::Defines& defines) {
    return evaluated("modern/evsm/warp.glsl", "litShare(mix(momentsOf(x.y), momentsOf(x.x), x.z), x.w)", inputs, defines);
}

Kernel kernelOf(const glm::vec4& x) { return {{x.x, x.z}, {x.y, 1 - x.z}}; }

std::vector<glm::vec4> kernels() {
    std::vector<glm::vec4> inputs;
    for (const float near : {0.02F, 0.3F, 0.6F})
        for (const float far : {0.35F, 0.7F, 0.97F})
            for (const float share : {0.1F, 0.5F, 0.9F})
                for (const float receiver : {0.1F, 0.5F, 0.72F, 0.99F}) inputs.emplace_back(near, far, share, receiver);
    return inputs;
}

TEST(EvsmShader, IsTheLeastOfTheBoundsByBothWarps) {
    for (const auto& [positive, negative] : {std::pair(40.0, 5.0), std::pair(15.0, 5.0), std::pair(5.54, 5.54)}) {
        const auto inputs = kernels();
        const auto both = litShares(inputs, definesOf("RGBA32F", positive, negative)),
                   one = litShares(inputs, definesOf("RG32F", positive, negative));
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const Kernel kernel = kernelOf(inputs[i]);
            const double byPositive = warpedBound(kernel, inputs[i].w, positive, leastVariance),
                         byNegative = warpedBound(kernel, inputs[i].w, -negative, leastVariance);
            // What llvmpipe's exponential leaves, raised to the power of 40 and taken from its like.
            EXPECT_NEAR(one[i].x, byPositive, 1e-3) << i;
            EXPECT_NEAR(both[i].x, std::min(byPositive, byNegative), 1e-3) << i;
        }
    }
}

TEST(EvsmShader, StaysWithinItsFloatsAtBothEndsOfDepth) {
    std::vector<glm::vec4> inputs;
    for (const float a : {0.0F, 1e-6F, 0.5F, 1.0F})
        for (const float b : {0.0F, 1e-6F, 0.5F, 1.0F})
            for (const float receiver : {0.0F, 1e-6F, 0.5F, 1.0F}) inputs.emplace_back(a, b, 0.5F, receiver);
    for (const char* format : {"RGBA32F", "RGBA16F"}) // of which the second holds no more than exp(11)
        for (const glm::vec4& share : litShares(inputs, definesOf(format, 42, 42))) {
            EXPECT_GE(share.x, 0);
            EXPECT_LE(share.x, 1);
        }
}

TEST(Evsm, AnEdgeIsARampOfTheKernelsWidth) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    for (const char* format : {"RGBA32F", "RG32F"})
        for (const int kernel : {3, 7}) {
            const auto points = groundPoints(
                stage, renderedModern(stage, "evsm", fmt::format("map=256,kernel={},format={}", kernel, format)));
            EXPECT_LT(fromRamp(points, kernel * texelOf(scene, 256)), 0.03) << kernel; // the ground's pixels are finite
            for (const GroundPoint& point : points) ASSERT_LT(point.at.x > edgeAt + 0.4 ? point.visibility : 0, 1e-3);
        }
}

TEST(Evsm, TwoOccludersLeakByTheWarpedDepthsBetweenThem) {
    const double lower = 1.5, upper = 5;
    const Scene scene = stackedScene(lower, upper);
    Stage stage(scene);
    stage.show(0);
    const auto unit = [&](double y) { return (upper + 0.1 - y) / (upper + 0.1 + 0.2); }; // of the scene from top to bottom
    const auto leakOf = [&](double positive) {
        double most = 0;
        for (double p = 0; p <= 1; p += 0.001) {
            const Kernel kernel{{unit(lower + 0.1), p}, {unit(upper + 0.1), 1 - p}};
            most = std::max(most, std::min(warpedBound(kernel, unit(0), positive, leastVariance),
                                           warpedBound(kernel, unit(0), -5, leastVariance)));
        }
        return most;
    };
    const double plain = brightest(groundPoints(stage, rendered(stage, "vsm:map=256")));
    for (const double positive : {3.0, 5.54, 15.0, 40.0}) {
        const double leak =
            brightest(groundPoints(stage, renderedModern(stage, "evsm", fmt::format("map=256,positive={}", positive))));
        EXPECT_NEAR(leak, leakOf(positive), 0.01) << positive;
        EXPECT_LT(leak, 0.5 * plain) << positive;
    }
    EXPECT_LT(leakOf(40), 1e-3);
}

// playcanvas#9125: the exponential of the farthest texel outweighs all others.
TEST(Evsm, APositiveWarpAloneLightsWhatLiesBeforeAnyOfItsKernel) {
    const std::vector<glm::vec4> inputs{{0.9F, 0.2F, 0.05F, 0.6F}}; // a twentieth of the kernel behind the receiver
    EXPECT_EQ(litShares(inputs, definesOf("RG32F", 40, 5)).front().x, 1);
    EXPECT_LT(litShares(inputs, definesOf("RGBA32F", 40, 5)).front().x, 0.2);
}

} // namespace
} // namespace shadowbench
