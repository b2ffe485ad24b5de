// Cube maps of directions and their Haar wavelets.
#include "techniques/environment/haar.h"

#include "base/random.h"
#include "techniques/environment/cube_light.h"
#include "techniques/environment/cube_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <numeric>

namespace shadowbench::techniques {
namespace {

constexpr double sphere = 4 * glm::pi<double>();

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<double> randomMap(int side, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> map(cubeTexels(side));
    for (double& x : map) x = random.uniform(-1, 1);
    return map;
}

std::vector<double> transformed(std::vector<double> map, int side) {
    haarTransform(map, side);
    return map;
}

TEST(CubeMap, PointsAndDirectionsAreInverse) {
    for (int face = 0; face < 6; ++face)
        for (const double x : {-0.9, 0.1})
            for (const double y : {-0.4, 0.7}) {
                const glm::dvec3 direction = directionOf({face, {x, y}});
                EXPECT_NEAR(glm::length(direction), 1, 1e-12);
                const CubePoint point = cubePointOf(direction);
                EXPECT_EQ(point.face, face);
                EXPECT_NEAR(point.at.x, x, 1e-12);
                EXPECT_NEAR(point.at.y, y, 1e-12);
            }
}

TEST(CubeMap, SamplesCoverTheSphereOnce) {
    EXPECT_NEAR(solidAngle({-1, -1}, {1, 1}), sphere / 6, 1e-12);
    for (const auto& [samples, count] : {std::pair{cubeSamples(16, 2), 6144U}, {evenSamples(1000), 1000U}}) {
        EXPECT_EQ(samples.size(), count);
        double whole = 0;
        glm::dvec3 middle(0);
        for (const DirectionSample& sample : samples) {
            whole += sample.solidAngle;
            middle += sample.solidAngle * glm::dvec3(sample.direction);
            EXPECT_NEAR(glm::length(sample.direction), 1, 1e-6);
        }
        EXPECT_NEAR(whole, sphere, 1e-9);
        EXPECT_NEAR(glm::length(middle), 0, 0.02);
    }
}

TEST(CubeMap, ASamplesTexelHoldsIt) {
    for (const DirectionSample& sample : cubeSamples(8, 3)) {
        const CubePoint point = cubePointOf(glm::dvec3(sample.direction));
        const auto x = static_cast<std::size_t>(4 * (point.at.x + 1)), y = static_cast<std::size_t>(4 * (point.at.y + 1));
        EXPECT_EQ(sample.texel, static_cast<std::size_t>(point.face) * 64 + 8 * y + x);
    }
}

TEST(Haar, KeepsDotProducts) {
    for (const int side : {2, 16, 64}) {
        const std::vector<double> a = randomMap(side, 1), b = randomMap(side, 2);
        EXPECT_NEAR(dot(transformed(a, side), transformed(b, side)), dot(a, b), 1e-10 * std::sqrt(dot(a, a) * dot(b, b)));
    }
}

TEST(Haar, IsUndoneByItsInverse) {
    for (const int side : {2, 16, 64}) {
        const std::vector<double> map = randomMap(side, 1);
        std::vector<double> back = transformed(map, side);
        inverseHaarTransform(back, side);
        for (std::size_t i = 0; i < map.size(); ++i) EXPECT_NEAR(back[i], map[i], 1e-12);
    }
}

TEST(Haar, OfAConstantIsTheMeanOfEachFace) {
    const std::vector<double> haar = transformed(std::vector<double>(cubeTexels(8), 0.5), 8);
    for (std::size_t i = 0; i < haar.size(); ++i) EXPECT_NEAR(haar[i], i % 64 == 0 ? 0.5 * 8 : 0, 1e-12) << i;
}

TEST(Haar, AFunctionSpansItsSupport) { // the map of which a single coefficient is the transform
    constexpr int side = 8;
    for (const std::size_t index : {0U, 1U, 3U, 8U, 20U, 63U, 64U, 7U * 8 + 2}) {
        std::size_t texels = 0;
        for (std::size_t texel = 0; texel < cubeTexels(side); ++texel) {
            std::vector<double> map(cubeTexels(side));
            map[texel] = 1;
            haarTransform(map, side);
            if (map[index] == 0) continue;
            ++texels;
            EXPECT_NEAR(std::abs(map[index]), 1 / std::sqrt(static_cast<double>(haarSupport(index, side))), 1e-12);
        }
        EXPECT_EQ(texels, haarSupport(index, side)) << index;
    }
}

TEST(Haar, TheLargestCoefficientsAreChosenByMagnitudeAndArea) {
    std::vector<double> coefficients(cubeTexels(8));
    coefficients[0] = 1;   // 64 texels: 8
    coefficients[1] = -2;  // 64 texels: 16
    coefficients[63] = 5;  // 4 texels: 10
    coefficients[70] = -3; // of the next face, 4 texels: 6
    EXPECT_EQ(largestCoefficients(coefficients, 8, 4), (std::vector<std::size_t>{1, 63, 0, 70}));
    EXPECT_EQ(largestCoefficients(coefficients, 8, 100000).size(), cubeTexels(8));
}

double lightOf(const std::vector<double>& texels, int side) {
    double sum = 0;
    for (const DirectionSample& sample : cubeSamples(side, 1)) sum += sample.solidAngle * texels[sample.texel];
    return sum;
}

TEST(CubeLight, KeepsTheLightOfASunOfAnySize) {
    for (const double diameter : {0.1, 0.53, 5.0, 40.0, 180.0}) {
        const Sun sun{glm::normalize(glm::dvec3(0.43, 0.71, -0.27)), diameter, 2};
        const std::vector<double> texels = cubeLight({ConstantSky{0}, {sun}}, 16);
        EXPECT_NEAR(lightOf(texels, 16), 2 * sun.solidAngle(), 1e-9);
        const DirectionSample brightest = [&] {
            const auto samples = cubeSamples(16, 1);
            return *std::ranges::max_element(samples, {}, [&](const DirectionSample& s) { return texels[s.texel]; });
        }();
        EXPECT_GT(glm::dot(glm::dvec3(brightest.direction), sun.direction), 0); // it is where the sun is
    }
}

TEST(CubeLight, OfASkyIsItsMeanInEachTexel) {
    for (const double x : cubeLight({ConstantSky{0.3}, {}}, 16)) EXPECT_EQ(x, 0.3);
    const HarmonicSky sky{{1, 0.2, 0.3, -0.1}};
    const std::vector<double> texels = cubeLight({sky, {}}, 16);
    EXPECT_NEAR(lightOf(texels, 16), std::sqrt(sphere), 1e-6); // the first function is √(1/4π) everywhere
    for (const DirectionSample& sample : cubeSamples(16, 1))
        EXPECT_NEAR(texels[sample.texel], radiance(sky, glm::dvec3(sample.direction)), 0.02);
}

} // namespace
} // namespace shadowbench::techniques
