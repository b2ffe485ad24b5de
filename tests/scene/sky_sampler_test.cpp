// Sampled directions of skies and suns against integrals that are known.
#include "base/random.h"
#include "scene/sky_sampler.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace shadowbench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSide = 64;         // of a regular grid of parameters
constexpr double kSteps = 0.0025; // what the steps of the density that harmonics are drawn by leave on such a grid

const HarmonicSky kFromAbove{{std::sqrt(4 * kPi), std::sqrt(4 * kPi / 3), 0, 0}}; // 1 + y

/// Two bright pixels on a dark ground, and black all below.
ImageSky brightPixels() {
    ImageSky sky{Image<float>(16, 8)};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) sky.radiance(x, y) = 0.5F;
    sky.radiance(3, 1) = 20;
    sky.radiance(11, 2) = 10;
    return sky;
}

/// Mean of the irradiance of a part's directions, each weighed by `weight`, over a regular grid of parameters.
template <typename Weight>
double mean(const SkySampler& sampler, std::size_t part, const Weight& weight) {
    double sum = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const SkyDirection drawn = sampler.at(part, {(i + 0.5) / kSide, (j + 0.5) / kSide});
            EXPECT_NEAR(glm::length(drawn.towards), 1, 1e-12);
            sum += drawn.irradiance * weight(drawn.towards);
        }
    return sum / (kSide * kSide);
}

double whole(const SkySampler& sampler, std::size_t part) {
    return mean(sampler, part, [](const glm::dvec3&) { return 1.0; });
}

double irradiance(const SkySampler& sampler, std::size_t part, const glm::dvec3& normal) {
    return mean(sampler, part, [&](const glm::dvec3& towards) { return irradianceWeight(towards, normal); });
}

TEST(SkySampler, BringsAllTheLightThereIs) {
    EXPECT_NEAR(whole(SkySampler({ConstantSky{0.7}, {}}), 0), 0.7 * 4 * kPi, 1e-9);
    EXPECT_NEAR(whole(SkySampler({kFromAbove, {}}), 0), 4 * kPi, kSteps * 4 * kPi);
    const Sun sun{glm::normalize(glm::dvec3(1, 2, 3)), 30, 5};
    EXPECT_NEAR(whole(SkySampler({ConstantSky{0}, {sun}}), 0), 5 * sun.solidAngle(), 1e-9);

    const ImageSky image = brightPixels();
    double sum = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const double top = std::cos(kPi * y / 8), bottom = std::cos(kPi * (y + 1) / 8);
            sum += static_cast<double>(image.radiance(x, y)) * (top - bottom) * 2 * kPi / 16;
        }
    EXPECT_NEAR(whole(SkySampler({image, {}}), 0), sum, 1e-6);
}

TEST(SkySampler, LightsSurfacesAsTheIntegralsSay) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(3, 4, 1));
    EXPECT_NEAR(irradiance(SkySampler({ConstantSky{1}, {}}), 0, normal), kPi, 2e-3);
    EXPECT_NEAR(irradiance(SkySampler({kFromAbove, {}}), 0, normal), kPi * (1 + 2.0 / 3 * normal.y), kSteps * 2 * kPi);
    const Sun sun{glm::normalize(glm::dvec3(1, 2, 0)), 40, 3}; // wholly above the tangent plane: π sin² r cos θ
    const double sine = std::sin(glm::radians(20.0));
    EXPECT_NEAR(irradiance(SkySampler({ConstantSky{0}, {sun}}), 0, normal),
                3 * kPi * sine * sine * glm::dot(sun.direction, normal), 1e-4);
}

TEST(SkySampler, DrawsAnImagesDirectionsWhereItsLightIs) {
    const ImageSky image = brightPixels();
    const SkySampler sampler({image, {}});
    const double all = whole(sampler, 0);
    double inBright = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const SkyDirection drawn = sampler.at(0, {(i + 0.5) / kSide, (j + 0.5) / kSide});
            EXPECT_GT(radiance(image, drawn.towards), 0);
            EXPECT_NEAR(drawn.irradiance, all, 1e-9); // equal shares
            if (radiance(image, drawn.towards) > 15) ++inBright;
        }
    const double share = 20 * (std::cos(kPi / 8) - std::cos(kPi / 4)) * 2 * kPi / 16 / all;
    EXPECT_NEAR(inBright / (kSide * kSide), share, 0.01);
}

TEST(SkySampler, KeepsParametersInTheirOrder) {
    const SkySampler sampler({brightPixels(), {}});
    double height = 1;
    for (int i = 0; i < 100; ++i) { // rows from the zenith down
        const double now = sampler.at(0, {(i + 0.5) / 100, 0.3}).towards.y;
        EXPECT_LT(now, height);
        height = now;
    }
}

TEST(SkySampler, DrawsTheSunsDirectionsFromItsDisk) {
    Sun sun{glm::normalize(glm::dvec3(-1, 0.2, 0.4)), 0.53, 1};
    const SkySampler sampler({ConstantSky{1}, {sun, Sun{{0, -1, 0}, 60, 2}}});
    ASSERT_EQ(sampler.parts(), 3U);
    EXPECT_FALSE(sampler.isSun(0));
    EXPECT_TRUE(sampler.isSun(1) && sampler.isSun(2));
    sun.diameter *= 1 + 1e-9; // rounding at the rim
    int inner = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const glm::dvec3 towards = sampler.at(1, {(i + 0.5) / kSide, (j + 0.5) / kSide}).towards;
            EXPECT_TRUE(sun.contains(towards));
            inner += Sun{sun.direction, 0.5 * sun.diameter, 1}.contains(towards) ? 1 : 0;
        }
    EXPECT_NEAR(inner, 0.25 * kSide * kSide, kSide); // half the radius holds a quarter; one row of the grid
}

TEST(SkySampler, LeavesOutABlackSky) {
    EXPECT_EQ(SkySampler({ConstantSky{0}, {Sun{}}}).parts(), 1U);
    EXPECT_TRUE(SkySampler({ConstantSky{0}, {Sun{}}}).isSun(0));
    EXPECT_EQ(SkySampler({ImageSky{Image<float>(4, 2, 0)}, {Sun{}}}).parts(), 1U);
    EXPECT_EQ(SkySampler({ConstantSky{1}, {}}).parts(), 1U);
}

TEST(SkySampler, IsDefinedAtTheEndsOfTheSquare) {
    const double last = 1 - 0x1p-53;
    for (const EnvironmentLight& light : {EnvironmentLight{ConstantSky{1}, {}}, EnvironmentLight{kFromAbove, {}},
                                          EnvironmentLight{brightPixels(), {}}, EnvironmentLight{ConstantSky{0}, {Sun{}}}})
        for (const double s : {0.0, last})
            for (const double t : {0.0, last}) {
                const SkyDirection drawn = SkySampler(light).at(0, {s, t});
                EXPECT_NEAR(glm::length(drawn.towards), 1, 1e-12);
                EXPECT_TRUE(std::isfinite(drawn.irradiance));
                EXPECT_GE(drawn.irradiance, 0);
            }
}

} // namespace
} // namespace shadowbench
