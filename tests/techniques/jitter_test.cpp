// Jittered taps: one in every cell of equal area, the outermost ring first.
#include "techniques/shared/sampling/jitter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <set>
#include <utility>

namespace shadowbench::techniques {
namespace {

/// The inverse of `warpedToDisk`.
glm::dvec2 unwarped(const glm::dvec2& at) {
    const double turn = std::atan2(at.y, at.x) / glm::two_pi<double>();
    return {turn < 0 ? turn + 1 : turn, glm::dot(at, at)};
}

TEST(JitteredTaps, HaveOneInEveryCell) {
    for (const JitterGrid grid : {JitterGrid{8, 8}, JitterGrid{8, 4}, JitterGrid{4, 4}, JitterGrid{8, 2}})
        for (std::uint32_t set = 0; set < 40; ++set) {
            const auto taps = jitteredTaps(grid, set);
            ASSERT_EQ(taps.size(), static_cast<std::size_t>(grid.taps()));
            std::set<std::pair<int, int>> cells;
            for (const glm::vec2& tap : taps) {
                const glm::dvec2 at = unwarped(tap);
                cells.emplace(static_cast<int>(at.x * grid.sectors), static_cast<int>(at.y * grid.rings));
            }
            EXPECT_EQ(cells.size(), taps.size()) << set; // 32-bit floats leave none on the wrong side of a border
        }
}

TEST(JitteredTaps, BeginWithTheOutermostRing) {
    const JitterGrid grid{8, 8};
    for (std::uint32_t set = 0; set < 100; ++set) {
        const auto taps = jitteredTaps(grid, set);
        for (std::size_t i = 0; i < taps.size(); ++i) EXPECT_EQ(unwarped(taps[i]).y > 7.0 / 8, i < 8) << set << " " << i;
    }
}

TEST(JitteredTaps, FillTheDiskEvenly) {
    // The mean of x² over a disk is a quarter; that of x and of xy is nothing.
    double x = 0, xx = 0, xy = 0;
    constexpr std::uint32_t sets = 1024;
    const JitterGrid grid{8, 8};
    for (std::uint32_t set = 0; set < sets; ++set)
        for (const glm::dvec2 tap : jitteredTaps(grid, set)) {
            x += tap.x;
            xx += tap.x * tap.x;
            xy += tap.x * tap.y;
        }
    const double count = sets * grid.taps();
    // 65,536 taps that were independent would have a standard error of 0.002 and less.
    EXPECT_NEAR(x / count, 0, 0.003);
    EXPECT_NEAR(xx / count, 0.25, 0.003);
    EXPECT_NEAR(xy / count, 0, 0.003);
}

TEST(JitteredTaps, DifferFromSetToSet) {
    const JitterGrid grid{8, 8};
    EXPECT_EQ(jitteredTaps(grid, 5), jitteredTaps(grid, 5));
    // In a cell of its own a tap is where it was in the set before as rarely as chance has it.
    double same = 0, count = 0;
    for (std::uint32_t set = 0; set < 256; ++set) {
        const auto taps = jitteredTaps(grid, set), next = jitteredTaps(grid, set + 1);
        for (std::size_t i = 0; i < taps.size(); ++i) {
            same += glm::distance(taps[i], next[i]) < 0.02F ? 1 : 0;
            ++count;
        }
    }
    // A disk of 0.02 over a cell of π/64 is one in forty.
    EXPECT_LT(same / count, 0.04);
}

} // namespace
} // namespace shadowbench::techniques
