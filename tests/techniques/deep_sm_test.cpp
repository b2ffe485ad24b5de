// Transmittance functions without GL: what they hold, and what compression may do to them.
#include "base/error.h"
#include "techniques/filtered/deep-sm/deep_texture.h"
#include "techniques/filtered/deep-sm/transmittance.h"
#include "tests/support/models/deep_sm.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace shadowbench::techniques {
namespace {

using models::transmittanceAt;

Transmittance steps(std::vector<float> hits, int samples) {
    std::sort(hits.begin(), hits.end());
    Transmittance function;
    gatherSteps(hits, samples, function);
    return function;
}

Transmittance compressed(const Transmittance& exact, float error) {
    Transmittance result;
    compress(exact, error, result);
    return result;
}

/// Largest difference anywhere: both are linear between vertices, so it is at a vertex of either, on one of its two sides.
double largestDifference(const Transmittance& a, const Transmittance& b) {
    double most = 0;
    for (const Transmittance* function : {&a, &b})
        for (const TransmittanceNode& node : *function)
            for (const double depth :
                 {static_cast<double>(node.depth), static_cast<double>(std::nextafter(node.depth, 2.0F))})
                most = std::max(most, std::abs(transmittanceAt(a, depth) - transmittanceAt(b, depth)));
    return most;
}

TEST(TransmittanceAt, IsOneBeforeLinearBetweenAndConstantBehind) {
    const Transmittance function{{0.25F, 1}, {0.5F, 0.5F}, {0.5F, 0.25F}};
    EXPECT_EQ(transmittanceAt(function, 0), 1);
    EXPECT_EQ(transmittanceAt(function, 0.25), 1);
    EXPECT_EQ(transmittanceAt(function, 0.375), 0.75);
    EXPECT_EQ(transmittanceAt(function, 0.5), 0.5); // the upper end of the jump
    EXPECT_EQ(transmittanceAt(function, 0.51), 0.25);
    EXPECT_EQ(transmittanceAt({}, 0.5), 1);
}

TEST(GatherSteps, AreTheSharesOfSamplesNotYetStopped) {
    const Transmittance function = steps({0.5F, 0.2F, 0.5F}, 4);
    EXPECT_EQ(transmittanceAt(function, 0.2), 1);
    EXPECT_EQ(transmittanceAt(function, 0.3), 0.75);
    EXPECT_EQ(transmittanceAt(function, 0.6), 0.25);
    EXPECT_TRUE(steps({}, 4).empty());
}

TEST(Compress, StaysWithinTheErrorAndFalls) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.01F, 0.99F);
    for (int round = 0; round < 500; ++round) {
        std::vector<float> hits(1 + random() % 64);
        const float cluster = uniform(random);
        for (float& hit : hits) hit = random() % 3 == 0 ? uniform(random) : cluster + 0.01F * uniform(random);
        const Transmittance exact = steps(hits, 64);
        for (const float error : {0.0F, 0.01F, 0.04F, 0.2F}) {
            const Transmittance result = compressed(exact, error);
            EXPECT_LE(result.size(), exact.size());
            EXPECT_LE(largestDifference(exact, result), static_cast<double>(error) + 2e-5); // 32-bit slopes
            for (std::size_t i = 1; i < result.size(); ++i) {
                ASSERT_LE(result[i].transmittance, result[i - 1].transmittance);
                ASSERT_GE(result[i].depth, result[i - 1].depth);
            }
        }
    }
}

TEST(Compress, ASlantedSurfaceIsOneSegment) { // 16 steps, evenly apart
    std::vector<float> hits;
    for (int i = 0; i < 16; ++i) hits.push_back(0.5F + 0.001F * static_cast<float>(i));
    EXPECT_LE(compressed(steps(hits, 16), 0.07F).size(), 3U);  // more than a step of 1/16
    EXPECT_GE(compressed(steps(hits, 16), 0.02F).size(), 32U); // less than half a step: nothing can be left out
}

TEST(Compress, ASurfaceAcrossTheLightIsOneJump) {
    const Transmittance result = compressed(steps(std::vector<float>(16, 0.5F), 16), 0.04F);
    EXPECT_EQ(result.size(), 2U);
    EXPECT_EQ(transmittanceAt(result, 0.5), 1);
    EXPECT_EQ(transmittanceAt(result, 0.50001), 0);
}

TEST(Compress, LitStaysLitAndFullShadowStaysDark) {
    for (const std::vector<float>& hits : {std::vector<float>{0.2F, 0.3F, 0.31F, 0.6F}, std::vector<float>(4, 0.4F)}) {
        const Transmittance exact = steps(hits, 4), result = compressed(exact, 0.1F);
        EXPECT_EQ(transmittanceAt(result, static_cast<double>(exact.front().depth)), 1);
        EXPECT_NEAR(transmittanceAt(result, 1), 0, 1e-6);
    }
}

TEST(Compress, AWiderErrorTakesFewerNodes) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0.1F, 0.9F);
    std::vector<float> hits(64);
    for (float& hit : hits) hit = uniform(random);
    const Transmittance exact = steps(hits, 64);
    const auto size = [&](float error) { return compressed(exact, error).size(); };
    EXPECT_GT(size(0.01F), 2 * size(0.05F));
    EXPECT_GT(size(0.05F), size(0.2F));
    EXPECT_LE(size(0.2F), 6U);
}

TEST(DeepTexture, ATexelHoldsItsOwnSamples) {
    Image<float> depths(4, 4, 1.0F); // two by two texels, row 0 at the top
    depths(2, 0) = 0.25F;
    depths(3, 1) = 0.5F;
    DeepTexture deep;
    buildDeepTexture(depths, 2, 0, deep);
    EXPECT_EQ(deep.first, (std::vector<std::uint32_t>{0, 0, 0, 0, 4})); // the top right texel is the last
    EXPECT_EQ(transmittanceAt(deep.nodes, 0.4), 0.75);
    EXPECT_EQ(transmittanceAt(deep.nodes, 0.6), 0.5);
    EXPECT_THROW(buildDeepTexture(depths, 3, 0, deep), InternalError);
}

} // namespace
} // namespace shadowbench::techniques
