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

/// The inverse of `warped`.
glm::dvec2 unwarped(const glm::dvec2& at, Region region) {
    if (region == Region::Disk) {
        const double turn = std::atan2(at.y, at.x) / glm::two_pi<double>();
        return {turn < 0 ? turn + 1 : turn, glm::dot(at, at)};
    }
    const double reach = std::max(std::abs(at.x), std::abs(at.y));
    const glm::dvec2 p = at / reach;
    const bool right = p.x == 1, top = p.y == 1, left = p.x == -1;
    const double side = right ? 0 : top ? 1 : left ? 2 : 3;
    const double along = right ? p.y : top ? -p.x : left ? -p.y : p.x;
    return {(side + 0.5 * (along + 1)) / 4, reach * reach};
}

class JitteredTaps : public testing::TestWithParam<Region> {};

TEST_P(JitteredTaps, HaveOneInEveryCell) {
    for (const JitterGrid grid : {JitterGrid{8, 8}, JitterGrid{8, 4}, JitterGrid{4, 4}, JitterGrid{8, 2}})
        for (std::uint32_t set = 0; set < 40; ++set) {
            const auto taps = jitteredTaps(grid, GetParam(), set);
            ASSERT_EQ(taps.size(), static_cast<std::size_t>(grid.taps()));
            std::set<std::pair<int, int>> cells;
            for (const glm::vec2& tap : taps) {
                const glm::dvec2 at = unwarped(tap, GetParam());
                cells.emplace(static_cast<int>(at.x * grid.sectors), static_cast<int>(at.y * grid.rings));
            }
            EXPECT_EQ(cells.size(), taps.size()) << set; // 32-bit floats leave none on the wrong side of a border
        }
}

TEST_P(JitteredTaps, BeginWithTheOutermostRing) {
    const JitterGrid grid{8, 8};
    for (std::uint32_t set = 0; set < 100; ++set) {
        const auto taps = jitteredTaps(grid, GetParam(), set);
        for (std::size_t i = 0; i < taps.size(); ++i)
            EXPECT_EQ(unwarped(taps[i], GetParam()).y > 7.0 / 8, i < 8) << set << " " << i;
    }
}

TEST_P(JitteredTaps, FillTheRegionEvenly) {
    // The mean of x² over a disk is a quarter, over a square a third; that of x and of xy is nothing.
    double x = 0, xx = 0, xy = 0;
    constexpr std::uint32_t sets = 1024;
    const JitterGrid grid{8, 8};
    for (std::uint32_t set = 0; set < sets; ++set)
        for (const glm::dvec2 tap : jitteredTaps(grid, GetParam(), set)) {
            x += tap.x;
            xx += tap.x * tap.x;
            xy += tap.x * tap.y;
        }
    const double count = sets * grid.taps();
    // 65,536 taps that were independent would have a standard error of 0.002 and less.
    EXPECT_NEAR(x / count, 0, 0.003);
    EXPECT_NEAR(xx / count, GetParam() == Region::Disk ? 0.25 : 1.0 / 3, 0.003);
    EXPECT_NEAR(xy / count, 0, 0.003);
}

TEST_P(JitteredTaps, DifferFromSetToSet) {
    const JitterGrid grid{8, 8};
    EXPECT_EQ(jitteredTaps(grid, GetParam(), 5), jitteredTaps(grid, GetParam(), 5));
    // In a cell of its own a tap is where it was in the set before as rarely as chance has it.
    double same = 0, count = 0;
    for (std::uint32_t set = 0; set < 256; ++set) {
        const auto taps = jitteredTaps(grid, GetParam(), set), next = jitteredTaps(grid, GetParam(), set + 1);
        for (std::size_t i = 0; i < taps.size(); ++i) {
            same += glm::distance(taps[i], next[i]) < 0.02F ? 1 : 0;
            ++count;
        }
    }
    // A disk of 0.02 over a cell of π/64 or 4/64.
    EXPECT_LT(same / count, 0.04);
}

INSTANTIATE_TEST_SUITE_P(Regions, JitteredTaps, testing::Values(Region::Disk, Region::Square),
                         [](const auto& region) { return region.param == Region::Disk ? "Disk" : "Square"; });

} // namespace
} // namespace shadowbench::techniques
