// Bias and noise over seeds, of images with a known error.
#include "base/random.h"
#include "tests/support/metrics_images.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr int side = 128;
constexpr double brighter = 0.05; // everywhere
constexpr double wave = 0.04;     // more in one half, less in the other
constexpr double noise = 0.1;     // up or down by as much, by seed and pixel

/// What a technique of that error draws of a truth of ½.
Image<float> drawn(std::uint64_t seed) {
    Random random(seed);
    return test::imageOf(side, side, [&](glm::dvec2 p) {
        return 0.5 + brighter + (p.x < side / 2 ? wave : -wave) + (random.uniform() < 0.5 ? noise : -noise);
    });
}

std::optional<metrics::SeedErrors> errorsOf(int seeds) {
    const groundtruth::Reference truth = test::truthOf(side, side, [](glm::dvec2) { return 0.5; });
    const metrics::Mask mask = test::everything(truth);
    std::vector<Image<float>> images;
    for (int seed = 1; seed <= seeds; ++seed) images.push_back(drawn(static_cast<std::uint64_t>(seed)));
    return metrics::seedErrors({images, truth, mask});
}

TEST(MeanInterval, IsStudentsOverTheSamples) {
    const auto [mean, half] = metrics::meanInterval({2, 4, 4, 6}); // deviation 1.63299, t of 3 degrees 3.18245
    EXPECT_DOUBLE_EQ(mean, 4);
    EXPECT_NEAR(half, 3.18245 * 1.63299 / 2, 1e-4);
    EXPECT_EQ(metrics::meanInterval({0.1, 0.1, 0.1}).half, 0);
    EXPECT_EQ(metrics::meanInterval({3}).half, 0);
}

TEST(SeedErrors, AreThoseThatTheImagesWereMadeWith) {
    const double systematic = std::hypot(brighter, wave);
    for (const int seeds : {2, 8, 32}) {
        const auto found = errorsOf(seeds);
        ASSERT_TRUE(found);
        const double sigma = noise / std::sqrt(static_cast<double>(seeds) * side * side); // of the mean of all
        EXPECT_NEAR(found->bias, brighter, 5 * sigma) << seeds;
        EXPECT_NEAR(found->noise, noise, 0.02 * noise) << seeds;
        EXPECT_NEAR(found->systematic, systematic, 0.03 * systematic) << seeds;
        EXPECT_NEAR(found->rmse, std::hypot(systematic, noise), 0.02) << seeds;
        EXPECT_NEAR(found->rmse * found->rmse, found->systematic * found->systematic + found->noise * found->noise, 1e-9)
            << seeds;
    }
}

TEST(SeedErrors, OfImagesThatAreTheSameHaveNoNoiseAndOfOneSeedAreAbsent) {
    const groundtruth::Reference truth = test::truthOf(8, 8, [](glm::dvec2) { return 0.5; });
    const metrics::Mask mask = test::everything(truth);
    const std::vector<Image<float>> images(4, Image<float>(8, 8, 0.75F));
    const auto found = metrics::seedErrors({images, truth, mask});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->noise, 0);
    EXPECT_EQ(found->bias, 0.25);
    EXPECT_EQ(found->systematic, 0.25);
    EXPECT_EQ(found->rmse, 0.25);
    EXPECT_FALSE(errorsOf(1));
}

TEST(SeedErrors, CountReceiversOnly) {
    const groundtruth::Reference truth = test::truthOf(8, 8, [](glm::dvec2) { return 0.5; });
    metrics::Mask mask = test::everything(truth);
    mask.scored(0, 0) = 0;
    --mask.count;
    std::vector<Image<float>> images(2, truth.visibility);
    images[0](0, 0) = 1;
    EXPECT_EQ(metrics::seedErrors({images, truth, mask})->rmse, 0);
}

} // namespace
} // namespace shadowbench
