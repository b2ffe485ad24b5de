// Tiles of a texture for parts of a light's plane against closed forms.
#include "techniques/maps/sm-tiled/tiling.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace shadowbench::techniques {
namespace {

constexpr int cells = 16, side = 1024;

/// One demand in each cell of the rectangle between `low` and `high`.
void addEven(std::vector<Demand>& demands, glm::ivec2 low, glm::ivec2 high, glm::vec2 pixels, int plane = 0) {
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x)
            demands.push_back({plane, (glm::vec2(x, y) + 0.5F) / static_cast<float>(cells), pixels});
}

const PlaneTile whole{0, {0, 0}, {cells, cells}, {{0, 0}, {side, side}}};

TEST(Tiling, LeavesAnEvenlySeenPlaneWhole) {
    std::vector<Demand> demands;
    addEven(demands, {0, 0}, {cells, cells}, {100, 100});
    EXPECT_EQ(tilesFor(demands, 1, cells, side, 16), std::vector{whole});
}

TEST(Tiling, GivesAllTexelsToWhatIsSeen) {
    std::vector<Demand> demands;
    addEven(demands, {4, 2}, {8, 10}, {100, 100});
    EXPECT_EQ(tilesFor(demands, 1, cells, side, 1), (std::vector{PlaneTile{0, {4, 2}, {4, 8}, whole.texels}}));
}

TEST(Tiling, SharesTexelsByTheRootOfTheWeight) {
    std::vector<Demand> demands; // pixels nine times as long on one half
    addEven(demands, {0, 0}, {cells / 2, cells}, {900, 0});
    addEven(demands, {cells / 2, 0}, {cells, cells}, {100, 0});
    const auto tiles = tilesFor(demands, 1, cells, side, 2);
    EXPECT_EQ(tiles, (std::vector{PlaneTile{0, {0, 0}, {8, 16}, {{0, 0}, {768, side}}},
                                  PlaneTile{0, {8, 0}, {8, 16}, {{768, 0}, {256, side}}}}));
}

TEST(Tiling, CutsAlongTheAxisThatSavesMore) {
    std::vector<Demand> demands; // the same change along y
    addEven(demands, {0, 0}, {cells, cells / 2}, {0, 100});
    addEven(demands, {0, cells / 2}, {cells, cells}, {0, 900});
    const auto tiles = tilesFor(demands, 1, cells, side, 2);
    EXPECT_EQ(tiles, (std::vector{PlaneTile{0, {0, 0}, {16, 8}, {{0, 0}, {side, 256}}},
                                  PlaneTile{0, {0, 8}, {16, 8}, {{0, 256}, {side, 768}}}}));
}

TEST(Tiling, CutsOutAGapThatNobodySees) {
    std::vector<Demand> demands;
    addEven(demands, {0, 0}, {2, cells}, {100, 100});
    addEven(demands, {14, 0}, {16, cells}, {100, 100});
    const auto tiles = tilesFor(demands, 1, cells, side, 2);
    EXPECT_EQ(tiles, (std::vector{PlaneTile{0, {0, 0}, {2, 16}, {{0, 0}, {512, side}}},
                                  PlaneTile{0, {14, 0}, {2, 16}, {{512, 0}, {512, side}}}}));
}

TEST(Tiling, GivesEveryPlaneThatIsSeenATile) {
    std::vector<Demand> demands;
    for (const int plane : {0, 2, 3, 5}) addEven(demands, {0, 0}, {cells, cells}, {100, 100}, plane);
    const auto tiles = tilesFor(demands, 6, cells, side, 1);
    ASSERT_EQ(tiles.size(), 4U);
    for (const PlaneTile& tile : tiles) EXPECT_EQ(tile.texels.size, glm::ivec2(512)) << tile.plane;
    EXPECT_TRUE(tilesFor({}, 6, cells, side, 16).empty());
}

TEST(Tiling, KeepsTilesApartInTheAtlasAndHoldsEveryDemand) {
    std::vector<Demand> demands;
    std::mt19937 random(3);
    const auto next = [&] { return static_cast<float>(random() >> 8) / 16777216.0F; };
    for (int i = 0; i < 2000; ++i) {
        const float x = next(), y = next();
        demands.push_back({i % 3, {x * x, 0.5F * y * y * y + 0.3F}, {20 / (x * x + 0.01F), 2000 * next()}});
    }
    for (const int count : {3, 7, 16, 64}) {
        const auto tiles = tilesFor(demands, 3, cells, side, count);
        EXPECT_EQ(tiles.size(), static_cast<std::size_t>(count));
        std::vector<int> owners(static_cast<std::size_t>(side) * side, 0);
        for (const PlaneTile& tile : tiles)
            for (int y = 0; y < tile.texels.size.y; ++y)
                for (int x = 0; x < tile.texels.size.x; ++x)
                    ++owners.at(static_cast<std::size_t>(tile.texels.at.y + y) * side +
                                static_cast<std::size_t>(tile.texels.at.x + x));
        EXPECT_EQ(std::count(owners.begin(), owners.end(), 1), side * side); // as many texels as one map, each once
        const auto table = tileTable(tiles, 3, cells);
        for (const Demand& demand : demands) {
            const glm::ivec2 cell = cellOf(demand.at, cells);
            ASSERT_NE(table[static_cast<std::size_t>((demand.plane * cells + cell.y) * cells + cell.x)], 0U);
        }
    }
}

} // namespace
} // namespace shadowbench::techniques
