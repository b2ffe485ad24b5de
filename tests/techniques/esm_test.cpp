// The exponential test without GL.
#include "tests/support/models/esm.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench::models {
namespace {

constexpr double c = 80;

TEST(ExponentialTest, AnEdgeFarBeforeTheReceiverIsTheShareThatPasses) {
    const double receiver = 0.9, occluder = 0.4;
    for (const double lit : {0.1, 0.5, 0.9}) {
        const double mean = lit * std::exp(c * receiver) + (1 - lit) * std::exp(c * occluder);
        EXPECT_NEAR(exponentialTest(receiver, mean, c), lit, 1e-12);
    }
}

TEST(ExponentialTest, DoesNotLeakBetweenOccluders) { // both far before the receiver, unlike Chebyshev's bound
    const double mean = 0.5 * std::exp(c * 0.1) + 0.5 * std::exp(c * 0.6);
    EXPECT_LT(exponentialTest(0.9, mean, c), 1e-10);
}

TEST(ExponentialTest, ASlantedKernelIsLit) { // Jensen: the mean of the exponential is above that of the mean
    double mean = 0;
    for (int tap = -3; tap <= 3; ++tap) mean += std::exp(c * (0.5 + 0.01 * tap)) / 7;
    EXPECT_EQ(exponentialTest(0.5, mean, c), 1);
}

TEST(ExponentialTest, LeaksWhereAnOccluderIsCloseBefore) {
    for (const double gap : {0.001, 0.01, 0.05})
        EXPECT_NEAR(exponentialTest(0.5 + gap, std::exp(c * 0.5), c), std::exp(-c * gap), 1e-9);
    EXPECT_NEAR(exponentialTest(0.5 + exponentialReach(0.02, c), std::exp(c * 0.5), c), 0.02, 1e-9);
    EXPECT_NEAR(exponentialReach(0.5, c), std::log(2) / c, 1e-15);
}

TEST(ExponentialTest, LeaksWhereSomeOfTheKernelLiesFarther) { // a twentieth of it is enough
    const double mean = 0.95 * std::exp(c * 0.2) + 0.05 * std::exp(c * 0.95);
    EXPECT_EQ(exponentialTest(0.9, mean, c), 1);
}

} // namespace
} // namespace shadowbench::models
