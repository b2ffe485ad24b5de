#include "groundtruth/povray/povray.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::groundtruth {
namespace {

/// Number of the box of an elementary interval 2^-a × 2^-b that holds the point.
int cell(glm::dvec2 point, int a, int b) {
    return (static_cast<int>(point.x * (1 << a)) << b) + static_cast<int>(point.y * (1 << b));
}

/// Area of the part of the square [−½, ½]² where dot(p, normal) < offset: the CDF of a sum of two uniform variables.
double belowEdge(glm::dvec2 normal, double offset) {
    const double a = std::abs(normal.x), b = std::abs(normal.y), t = offset + 0.5 * (a + b);
    if (std::min(a, b) < 1e-9) return std::clamp(t / std::max(a, b), 0.0, 1.0);
    const auto square = [](double x) { return x > 0 ? x * x : 0; };
    return (square(t) - square(t - a) - square(t - b) + square(t - a - b)) / (2 * a * b);
}

TEST(LightSample, FirstPowersOfTwoFormANet) {
    for (int k = 0; k <= 10; ++k) {
        const int n = 1 << k;
        for (int a = 0; a <= k; ++a) {
            std::set<int> cells;
            for (int i = 0; i < n; ++i) cells.insert(cell(povray::lightSample(i, n), a, k - a));
            EXPECT_EQ(cells.size(), static_cast<std::size_t>(n)) << "2^-" << a << " × 2^-" << k - a;
        }
    }
}

TEST(LightSample, EveryPartOfTheSetIsANetToo) {
    constexpr int n = 1024;
    const povray::SampleParts parts = povray::sampleParts(n);
    ASSERT_EQ(parts.firstQuarter + parts.secondQuarter + parts.secondHalf, n);
    int start = 0;
    for (const int count : {parts.firstQuarter, parts.secondQuarter, parts.secondHalf}) {
        const int k = std::countr_zero(static_cast<unsigned>(count));
        for (int a = 0; a <= k; ++a) {
            std::set<int> cells;
            for (int i = 0; i < count; ++i) cells.insert(cell(povray::lightSample(start + i, n), a, k - a));
            EXPECT_EQ(cells.size(), static_cast<std::size_t>(count)) << "from point " << start;
        }
        start += count;
    }
}

TEST(LightSample, NoPartOfTheSetIsEverEmpty) {
    for (int n = povray::fewestLightSamples; n < 100; ++n) {
        const povray::SampleParts parts = povray::sampleParts(n);
        EXPECT_EQ(parts.firstQuarter + parts.secondQuarter + parts.secondHalf, n);
        EXPECT_GT(std::min({parts.firstQuarter, parts.secondQuarter, parts.secondHalf}), 0) << n;
    }
}

TEST(LightSample, PointsOfAPowerOfTwoAreCentredSoThatTheirMeanIsTheMiddle) {
    for (const int n : {1, 4, 256, 1024}) {
        glm::dvec2 sum(0);
        for (int i = 0; i < n; ++i) sum += povray::lightSample(i, n);
        EXPECT_DOUBLE_EQ(sum.x / n, 0.5) << n;
        EXPECT_DOUBLE_EQ(sum.y / n, 0.5) << n;
    }
}

TEST(LightSample, EdgesInAnyDirectionLeaveTheErrorOfANet) {
    // Share of the unit square below a straight edge, counted and exact (a sum of clipped triangles).
    constexpr int n = 1024;
    for (int degrees = 0; degrees < 180; degrees += 5) {
        const glm::dvec2 normal(std::cos(glm::radians(1.0 * degrees)), std::sin(glm::radians(1.0 * degrees)));
        double squares = 0;
        constexpr int edges = 200;
        for (int i = 0; i < edges; ++i) {
            const double offset = (i + 0.5) / edges - 0.5;
            int count = 0;
            for (int j = 0; j < n; ++j) count += glm::dot(povray::lightSample(j, n) - 0.5, normal) < offset;
            squares += std::pow(static_cast<double>(count) / n - belowEdge(normal, offset), 2);
        }
        EXPECT_LE(std::sqrt(squares / edges), 0.003)
            << degrees << "°"; // what a reference may err; unscrambled 0.0067 at 45°
    }
}

TEST(LightSample, StaysInsideTheUnitSquareForEveryCount) {
    for (const int n : {4, 6, 7, 100, 1000, povray::mostLightSamples}) {
        for (int i = 0; i < n; ++i) {
            const glm::dvec2 p = povray::lightSample(i, n);
            ASSERT_TRUE(p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1) << i << " of " << n;
        }
    }
}

} // namespace
} // namespace shadowbench::groundtruth
