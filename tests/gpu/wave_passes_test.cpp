// Waves of lanes whose passes are given, against what can be counted by hand.
#include "gpu/wave_passes.h"

#include <gtest/gtest.h>
#include <vector>

namespace shadowbench::gpu {
namespace {

using Sums = std::vector<std::uint64_t>;

/// Two marks: main's once, and `passes(x, y)` of a loop's.
template <typename Passes>
std::vector<std::uint32_t> image(std::size_t width, std::size_t height, const Passes& passes) {
    std::vector<std::uint32_t> counts;
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) counts.insert(counts.end(), {1, static_cast<std::uint32_t>(passes(x, y))});
    return counts;
}

TEST(WavePasses, TheLongestLaneOfATileDecides) {
    const WavePasses all = passesOfPixels(image(16, 16, [](std::size_t x, std::size_t) { return x; }), 2, 16, 16);
    EXPECT_EQ(all.waves64, (Sums{4, 2 * (7 + 15)}));
    EXPECT_EQ(all.waves32, (Sums{8, 4 * (7 + 15)}));
    EXPECT_EQ(all.quads, (Sums{64, 8 * (1 + 3 + 5 + 7 + 9 + 11 + 13 + 15)}));
    EXPECT_EQ(all.longest64, (Sums{1, 15}));
}

TEST(WavePasses, ATileIsEightWideAndFourOrEightHigh) {
    const WavePasses all = passesOfPixels(image(8, 8, [](std::size_t, std::size_t y) { return y; }), 2, 8, 8);
    EXPECT_EQ(all.waves32, (Sums{2, 3 + 7}));
    EXPECT_EQ(all.waves64, (Sums{1, 7}));
}

TEST(WavePasses, OfAnImageThatTilesDoNotFillTheRestCounts) {
    const WavePasses all = passesOfPixels(image(9, 5, [](std::size_t x, std::size_t y) { return 10 * y + x; }), 2, 9, 5);
    EXPECT_EQ(all.waves32, (Sums{4, 37 + 38 + 47 + 48}));
    EXPECT_EQ(all.waves64, (Sums{2, 47 + 48}));
    EXPECT_EQ(all.longest32, (Sums{1, 48}));
}

TEST(WavePasses, TwoWavesOfOneMarkEachAreNotOneOfBoth) {
    std::vector<std::uint32_t> counts(64 * 3, 0); // lanes of two waves of 32 take two sides of a condition
    for (std::size_t lane = 0; lane < 64; ++lane) counts[3 * lane] = counts[3 * lane + (lane < 32 ? 1 : 2)] = 1;
    const WavePasses all = passesOfGroups(counts, 3, 64);
    EXPECT_EQ(all.waves32, (Sums{2, 1, 1}));
    EXPECT_EQ(all.waves64, (Sums{1, 1, 1})) << "which as one wave takes both";
    EXPECT_EQ(all.quads, (Sums{16, 8, 8}));
}

TEST(WavePasses, NoWaveReachesIntoTheNextGroup) {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t lane = 0; lane < 3 * 40; ++lane) counts.push_back(lane);
    const WavePasses all = passesOfGroups(counts, 1, 40);
    EXPECT_EQ(all.waves32, (Sums{31 + 39 + 71 + 79 + 111 + 119}));
    EXPECT_EQ(all.waves64, (Sums{39 + 79 + 119}));
}

TEST(WavePasses, TargetsAddUp) {
    WavePasses all;
    EXPECT_TRUE(all.empty());
    const WavePasses one = passesOfGroups(std::vector<std::uint32_t>{1, 5, 1, 3}, 2, 64);
    all.add(one);
    all.add(one);
    EXPECT_EQ(all.waves64, (Sums{2, 10}));
    EXPECT_EQ(all.longest64, (Sums{2, 10}));
    EXPECT_FALSE(all.empty());
}

} // namespace
} // namespace shadowbench::gpu
