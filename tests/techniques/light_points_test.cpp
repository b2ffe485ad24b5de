// Where the light samples of sampled techniques lie.
#include "techniques/shared/sampling/light_points.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <utility>

namespace shadowbench::techniques {
namespace {

/// Whose points (s − ½, 0, t − ½) are those of s and t in the unit square.
const Light unitLight{LightKind::Rectangle, {0, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};

TEST(LightPoints, OfAHammersleySetAreInTheMiddleOfTheirStrata) {
    const auto points = lightPoints(unitLight, "hammersley", 5, 1);
    ASSERT_EQ(points.size(), 5U);
    for (int i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(points[static_cast<std::size_t>(i)].x + 0.5, (i + 0.5) / 5);
    EXPECT_DOUBLE_EQ(points[0].z + 0.5, 1.0 / 2); // the van der Corput sequence from 1 on
    EXPECT_DOUBLE_EQ(points[1].z + 0.5, 1.0 / 4);
    EXPECT_DOUBLE_EQ(points[2].z + 0.5, 3.0 / 4);
}

TEST(LightPoints, OfAHaltonSetTakeTwoBasesAndDifferFromSeedToSeed) {
    const auto points = lightPoints(unitLight, "halton", 3, 1);
    EXPECT_DOUBLE_EQ(points[2].x + 0.5, 3.0 / 4);
    EXPECT_DOUBLE_EQ(points[2].z + 0.5, 1.0 / 9);
    const auto more = lightPoints(unitLight, "halton", 4, 1), other = lightPoints(unitLight, "halton", 3, 2);
    EXPECT_EQ(std::vector<glm::dvec3>(more.begin(), more.begin() + 3), points); // a longer set begins with a shorter one
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(other[i], points[i]);
}

TEST(LightPoints, OfAGridAreTheMiddlesOfItsCells) {
    const auto points = lightPoints(unitLight, "grid", 11, 1); // nine, and two of them again
    std::set<std::pair<double, double>> cells;
    for (const glm::dvec3& p : points) cells.emplace(3 * p.x, 3 * p.z);
    EXPECT_EQ(cells.size(), 9U);
    EXPECT_EQ(points[9], points[0]);
    for (const auto& [x, z] : cells) {
        EXPECT_NEAR(x, std::round(x), 1e-12);
        EXPECT_NEAR(z, std::round(z), 1e-12);
    }
}

} // namespace
} // namespace shadowbench::techniques
