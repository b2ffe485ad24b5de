// What honest renders err by, from sets whose visible points are given.
#include "groundtruth/certify/honest_renders.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

constexpr int samples = 64;

/// Adds a point of fraction ½; of set `i`, `visible(i)` of the 64 points are visible and of its first quarter so many in
/// proportion, more by `quarterMore`.
void add(HonestRenders& renders, const std::function<int(std::size_t)>& visible, int quarterMore = 0) {
    const std::vector<int> sizes = renders.points().sizes();
    std::vector<int> counts{samples / 2};
    for (std::size_t set = 0; 1 + 2 * set < sizes.size(); ++set) {
        const int quarter = visible(set) * sizes[1 + 2 * set] / samples + quarterMore;
        counts.push_back(quarter);
        counts.push_back(visible(set) - quarter);
    }
    renders.add(0.5, counts);
}

HonestRenders honest() { return {LightKind::Rectangle, samples, 0}; }

TEST(HonestRenders, ThatErrAlikeLeaveTheirErrorAsBound) {
    HonestRenders renders = honest();
    add(
        renders, [](std::size_t) { return 40; }, 2); // errors of 1/8, and of 1/4 in the quarter
    add(renders, [](std::size_t) { return 28; });    // of −1/16
    const HonestBounds bounds = renders.bounds();
    EXPECT_NEAR(bounds.bias, 1.0 / 32, 1e-12);
    const double rms = std::hypot(1.0 / 8, 1.0 / 16) / std::sqrt(2.0);
    EXPECT_NEAR(bounds.rms, rms, 1e-12);
    EXPECT_NEAR(bounds.fall, rms / (std::hypot(1.0 / 4, 1.0 / 16) / std::sqrt(2.0)), 1e-12);
}

TEST(HonestRenders, ThatErrBothWaysLeaveAQuantileOfStudents) {
    HonestRenders renders = honest();
    add(renders,
        [](std::size_t set) { return set % 2 == 0 ? 36 : 28; }); // 64 sets, half of which err by 1/16, half by −1/16
    const double deviation = std::sqrt(64.0 / 63 * (1 + 1.0 / 64)) / 16; // of one more
    EXPECT_NEAR(renders.bounds().bias, 4.613 * deviation, 1e-12);
    EXPECT_NEAR(renders.bounds().rms, 1.0 / 16, 1e-12);

    HonestRenders uneven = honest();
    add(uneven, [](std::size_t set) { return set % 2 == 0 ? 36 : 40; }); // errors of 1/16 and 1/8
    const double logarithms = std::log(2.0) / 2 * std::sqrt(64.0 / 63 * (1 + 1.0 / 64));
    EXPECT_NEAR(uneven.bounds().rms, std::sqrt(1.0 / 128) * std::exp(4.613 * logarithms), 1e-9);
    EXPECT_NEAR(uneven.bounds().fall, 1, 1e-12);
}

TEST(HonestRenders, ThatAreRightByLuckErrByAQuarterOfASample) {
    HonestRenders renders = honest();
    add(renders, [](std::size_t) { return 32; });
    EXPECT_NEAR(renders.bounds().rms, 0.25 / samples, 1e-12);
    EXPECT_EQ(renders.bounds().bias, 0);
}

} // namespace
} // namespace shadowbench::groundtruth
