// Light and unshadowed transfer in spherical harmonics, against their integrals.
#include "techniques/environment/harmonic_light.h"

#include "techniques/environment/cube_map.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

constexpr double pi = glm::pi<double>();
constexpr double integrated = 1e-3; // what a lattice of 20,000 directions leaves of an integral over a jump

/// ∫ f(s) y(s) ds over the sphere.
ShVector integral(const std::function<double(const glm::dvec3&)>& f) {
    static const std::vector<DirectionSample> samples = evenSamples(20000);
    ShVector sum{};
    for (const DirectionSample& sample : samples) {
        const glm::dvec3 direction(sample.direction);
        const ShVector basis = shBasis(direction);
        const double weight = sample.solidAngle * f(direction);
        for (std::size_t i = 0; i < sum.size(); ++i) sum.at(i) += weight * basis.at(i);
    }
    return sum;
}

void expectNear(const ShVector& a, const ShVector& b, double tolerance) {
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a.at(i), b.at(i), tolerance) << "coefficient " << i;
}

TEST(HarmonicLight, TheBasisIsOrthonormal) {
    for (std::size_t i = 0; i < shCount; ++i) {
        ShVector unit{};
        unit.at(i) = 1;
        expectNear(integral([i](const glm::dvec3& s) { return shBasis(s).at(i); }), unit, 1e-4);
    }
}

TEST(HarmonicLight, TheClampedCosineHasTheFactorsOfRamamoorthiAndHanrahan) {
    EXPECT_NEAR(clampedCosine(0), pi, 1e-12);
    EXPECT_NEAR(clampedCosine(1), 2 * pi / 3, 1e-12);
    EXPECT_NEAR(clampedCosine(2), pi / 4, 1e-12);
    EXPECT_EQ(clampedCosine(3), 0);
    EXPECT_NEAR(clampedCosine(4), -pi / 24, 1e-12);
    EXPECT_NEAR(clampedCosine(6), pi / 64, 1e-12);
}

TEST(HarmonicLight, UnshadowedTransferIsTheIntegralOfTheCosine) {
    for (const glm::dvec3 n : {glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(-0.3, 0.2, 0.9))})
        expectNear(unshadowedTransfer(n), integral([&](const glm::dvec3& s) { return std::max(0.0, glm::dot(n, s)); }),
                   integrated);
}

TEST(HarmonicLight, ASunIsTheIntegralOverItsDisk) {
    for (const double diameter : {20.0, 40.0, 180.0}) {
        const Sun sun{glm::normalize(glm::dvec3(0.4, 0.7, -0.2)), diameter, 1.7};
        expectNear(harmonicLight(sun), integral([&](const glm::dvec3& s) { return sun.contains(s) ? sun.radiance : 0; }),
                   3 * integrated);
    }
}

TEST(HarmonicLight, ASmallSunIsAllItsLightFromOneDirection) {
    const Sun sun{glm::normalize(glm::dvec3(0.4, 0.7, -0.2)), 0.01, 3};
    ShVector expected = shBasis(sun.direction);
    for (double& x : expected) x *= sun.radiance * sun.solidAngle();
    expectNear(harmonicLight(sun), expected, 1e-6 * sun.radiance * sun.solidAngle());
}

TEST(HarmonicLight, SkiesAreTheirIntegrals) {
    EnvironmentLight light{ConstantSky{0.7}, {}};
    expectNear(harmonicLight(light), integral([](const glm::dvec3&) { return 0.7; }), 1e-4);
    light.sky = HarmonicSky{{1, 0.2, 0.3, -0.1, 0.05, 0, 0, 0, 0.04}};
    expectNear(harmonicLight(light), integral([&](const glm::dvec3& s) { return radiance(light.sky, s); }), 1e-4);
    ImageSky image{Image<float>(64, 32)};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) image.radiance(x, y) = y < 16 ? 1 + 0.02F * static_cast<float>(x) : 0.1F;
    light.sky = image;
    expectNear(harmonicLight(light), integral([&](const glm::dvec3& s) { return radiance(light.sky, s); }), 0.01);
}

TEST(HarmonicLight, SunsAddUp) {
    const Sun a{{0, 1, 0}, 5, 2}, b{{1, 0, 0}, 30, 1};
    const ShVector both = harmonicLight(EnvironmentLight{ConstantSky{0}, {a, b}});
    for (std::size_t i = 0; i < both.size(); ++i)
        EXPECT_DOUBLE_EQ(both.at(i), harmonicLight(a).at(i) + harmonicLight(b).at(i));
}

} // namespace
} // namespace shadowbench::techniques
