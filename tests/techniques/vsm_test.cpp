// Variance shadow maps without GL: Chebyshev's bound and the box that the moments are averaged over.
#include "techniques/filtered/prefiltered_map.h"
#include "tests/support/models/vsm.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace shadowbench::techniques {
namespace {

using namespace models;

Moments momentsOf(const std::vector<double>& depths) {
    Moments moments;
    for (const double depth : depths) {
        moments.mean += depth / static_cast<double>(depths.size());
        moments.meanSquare += depth * depth / static_cast<double>(depths.size());
    }
    return moments;
}

TEST(ChebyshevBound, IsExactForAnOccluderBeforeAReceiver) { // Donnelly and Lauritzen: both parallel to the map
    for (const double lit : {0.01, 0.25, 0.5, 0.9}) {
        const double occluder = 0.3, receiver = 0.8;
        const Moments moments{lit * receiver + (1 - lit) * occluder,
                              lit * receiver * receiver + (1 - lit) * occluder * occluder};
        EXPECT_NEAR(chebyshevBound(moments, receiver), lit, 1e-12);
    }
}

TEST(ChebyshevBound, IsNeverBelowTheShareThatPasses) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int round = 0; round < 1000; ++round) {
        std::vector<double> depths(49);
        for (double& depth : depths) depth = uniform(random) < 0.5 ? 0.2 * uniform(random) : uniform(random);
        const double receiver = uniform(random);
        const auto passed = std::count_if(depths.begin(), depths.end(), [&](double d) { return d >= receiver; });
        EXPECT_GE(chebyshevBound(momentsOf(depths), receiver), static_cast<double>(passed) / 49 - 1e-12);
    }
}

TEST(ChebyshevBound, LeaksByHowFarTheOccludersAreApart) { // nothing of this kernel passes
    const std::vector<double> occluders{0.1, 0.5};
    const double closeBehind = chebyshevBound(momentsOf(occluders), 0.52);
    const double farBehind = chebyshevBound(momentsOf(occluders), 1.0);
    EXPECT_NEAR(closeBehind, 0.04 / (0.04 + 0.22 * 0.22), 1e-12); // variance 0.2², 0.22 beyond the mean
    EXPECT_NEAR(farBehind, 0.04 / (0.04 + 0.7 * 0.7), 1e-12);
    EXPECT_GT(closeBehind, 5 * farBehind);
}

TEST(ChebyshevBound, IsOneUpToTheMeanAndHoldsTheVarianceUp) {
    EXPECT_EQ(chebyshevBound({0.5, 0.25}, 0.5), 1);
    EXPECT_EQ(chebyshevBound({0.5, 0.25}, 0.51), 0);
    EXPECT_NEAR(chebyshevBound({0.5, 0.25}, 0.51, 1e-4), 0.5, 1e-9);
}

TEST(WithoutBleeding, CutsTheFootAndStretchesTheRest) {
    EXPECT_EQ(withoutBleeding(0.2, 0.3), 0);
    EXPECT_NEAR(withoutBleeding(0.65, 0.3), 0.5, 1e-12);
    EXPECT_EQ(withoutBleeding(1, 0.3), 1);
    EXPECT_EQ(withoutBleeding(0.4, 0), 0.4);
}

TEST(BoxFilter, ReadsAtMostNineTexelsWhateverItsWidth) {
    for (int kernel = 1; kernel <= 64; ++kernel) {
        const BoxFilter box = boxFilter(kernel);
        EXPECT_EQ(box.width * (1 << box.level), kernel);
        EXPECT_LE(box.width, 8);
        EXPECT_GT(box.width, box.level > 0 ? 4 : 0);
        double weights = 0;
        for (int offset = -4; offset <= 4; ++offset) weights += boxWeight(box.width, offset);
        EXPECT_NEAR(weights, box.width, 1e-12) << kernel;
    }
}

TEST(UnitDepth, RunsFromTheNearToTheFarDistance) {
    LightView view;
    view.depthFromWorld = {0, -1, 0, 7}; // a light's plane at y = 7, looking down
    view.near = 2;
    view.far = 6;
    EXPECT_EQ(glm::dot(unitDepthFromWorld(view), glm::dvec4(3, 5, 1, 1)), 0);
    EXPECT_EQ(glm::dot(unitDepthFromWorld(view), glm::dvec4(3, 1, 1, 1)), 1);
}

} // namespace
} // namespace shadowbench::techniques
