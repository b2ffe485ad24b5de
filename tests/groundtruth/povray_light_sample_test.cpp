#include "groundtruth/povray/povray.h"

#include <algorithm>
#include <bit>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::groundtruth {
namespace {

/// Number of the box of an elementary interval 2^-a × 2^-b that holds the point.
int cell(glm::dvec2 point, int a, int b) {
    return (static_cast<int>(point.x * (1 << a)) << b) + static_cast<int>(point.y * (1 << b));
}

TEST(LightSample, FirstPowersOfTwoFormANet) {
    for (int k = 0; k <= 10; ++k) {
        const int n = 1 << k;
        for (int a = 0; a <= k; ++a) {
            std::set<int> cells;
            for (int i = 0; i < n; ++i) cells.insert(cell(lightSample(i, n), a, k - a));
            EXPECT_EQ(cells.size(), static_cast<std::size_t>(n)) << "2^-" << a << " × 2^-" << k - a;
        }
    }
}

TEST(LightSample, EveryPartOfTheSetIsANetToo) {
    constexpr int n = 1024;
    const SampleParts parts = sampleParts(n);
    ASSERT_EQ(parts.firstQuarter + parts.secondQuarter + parts.secondHalf, n);
    int start = 0;
    for (const int count : {parts.firstQuarter, parts.secondQuarter, parts.secondHalf}) {
        const int k = std::countr_zero(static_cast<unsigned>(count));
        for (int a = 0; a <= k; ++a) {
            std::set<int> cells;
            for (int i = 0; i < count; ++i) cells.insert(cell(lightSample(start + i, n), a, k - a));
            EXPECT_EQ(cells.size(), static_cast<std::size_t>(count)) << "from point " << start;
        }
        start += count;
    }
}

TEST(LightSample, NoPartOfTheSetIsEverEmpty) {
    for (int n = fewestLightSamples; n < 100; ++n) {
        const SampleParts parts = sampleParts(n);
        EXPECT_EQ(parts.firstQuarter + parts.secondQuarter + parts.secondHalf, n);
        EXPECT_GT(std::min({parts.firstQuarter, parts.secondQuarter, parts.secondHalf}), 0) << n;
    }
}

TEST(LightSample, PointsOfAPowerOfTwoAreCentredSoThatTheirMeanIsTheMiddle) {
    for (const int n : {1, 4, 256, 1024}) {
        glm::dvec2 sum(0);
        for (int i = 0; i < n; ++i) sum += lightSample(i, n);
        EXPECT_DOUBLE_EQ(sum.x / n, 0.5) << n;
        EXPECT_DOUBLE_EQ(sum.y / n, 0.5) << n;
    }
}

TEST(LightSample, StaysInsideTheUnitSquareForEveryCount) {
    for (const int n : {4, 6, 7, 100, 1000, mostLightSamples}) {
        for (int i = 0; i < n; ++i) {
            const glm::dvec2 p = lightSample(i, n);
            ASSERT_TRUE(p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1) << i << " of " << n;
        }
    }
}

} // namespace
} // namespace shadowbench::groundtruth
