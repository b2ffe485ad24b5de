// Precomputed radiance transfer in Haar wavelets: sharper than spherical harmonics for small suns, with much more to store.
#include "base/error.h"
#include "techniques/environment/cube_light.h"
#include "techniques/environment/haar.h"
#include "techniques/environment/point_tracing.h"
#include "techniques/environment/prt-haar/haar_transfer.h"
#include "tests/support/environment_scenes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace techniques;

const EnvironmentLight sunInSky{HarmonicSky{{1, 0.2, 0.1, -0.15}}, {{glm::normalize(glm::dvec3(0.4, 0.8, -0.3)), 5, 40}}};

/// At a pixel of few points: the sum over texels, without wavelets, of the light's `texels` and what reaches each point.
class DirectSum {
public:
    DirectSum(const Snapshot& snapshot, std::size_t budget, int side, const std::vector<double>& texels)
        : points_(spreadPoints(snapshot, budget)), irradiance_(points_.points.size()), texels_(texels),
          samples_(cubeSamples(side, 1)) {
        const auto sources =
            tracePoints(points_, snapshot, samples_, [&](std::size_t i, std::span<const std::uint8_t> dark) {
                irradiance_[i] = sum(points_.points[i].normal, dark);
            });
        for (std::size_t i = 0; i < sources.size(); ++i) irradiance_[i] = irradiance_[sources[i]];
    }

    [[nodiscard]] double visibility(std::size_t surface, const glm::dvec3& at, const glm::dvec3& normal) const {
        const PointPatch& patch = points_.patches[models::patchAt(points_, surface, at, normal)];
        return std::clamp(models::interpolated(points_, patch, at, irradiance_) / sum(patch.normal, {}), 0.0, 1.0);
    }

private:
    [[nodiscard]] double sum(const glm::dvec3& normal, std::span<const std::uint8_t> dark) const {
        double result = 0;
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (dark.empty() || dark[i] == 0)
                result += texels_[samples_[i].texel] * samples_[i].solidAngle *
                          std::max(0.0, glm::dot(normal, glm::dvec3(samples_[i].direction)));
        return result;
    }

    SurfacePoints points_;
    std::vector<double> irradiance_;
    const std::vector<double>& texels_;
    std::vector<DirectionSample> samples_;
};

/// The greatest difference over the ground from the direct sum.
double fromDirectSum(Stage& stage, const Image<float>& v, int side, const std::vector<double>& texels) {
    const DirectSum model(stage.shown(), 300, side, texels);
    double worst = 0;
    std::size_t compared = 0;
    for (const SlabPoint& point : slabPoints(stage, v)) {
        ++compared;
        worst = std::max(worst, std::abs(point.visibility - model.visibility(1, point.at, {0, 1, 0})));
    }
    EXPECT_GT(compared, 2000U);
    return worst;
}

TEST(PrtHaar, AllCoefficientsAreTheDirectSum) {
    const Scene scene = under(boxScene(96), sunInSky);
    Stage stage(scene);
    stage.show(0);
    for (const int side : {16, 32}) {
        const Image<float> v = rendered(stage, fmt::format("prt-haar:n=24576,points=300,threshold=0,resolution={}", side));
        EXPECT_LE(fromDirectSum(stage, v, side, cubeLight(sunInSky, side)), 1e-5);
    }
}

TEST(PrtHaar, NCoefficientsAreTheDirectSumOfTheLightThatTheyHold) {
    constexpr int side = 16;
    const Scene scene = under(boxScene(96), sunInSky);
    Stage stage(scene);
    stage.show(0);
    std::vector<double> light = cubeLight(sunInSky, side);
    haarTransform(light, side);
    const std::vector<std::size_t> chosen = largestCoefficients(light, side, 20);
    std::vector<double> kept(light.size());
    for (const std::size_t i : chosen) kept[i] = light[i];
    inverseHaarTransform(kept, side);
    const Image<float> v = rendered(stage, "prt-haar:n=20,points=300,threshold=0,resolution=16");
    EXPECT_LE(fromDirectSum(stage, v, side, kept), 1e-5);
    EXPECT_GT(fromDirectSum(stage, v, side, cubeLight(sunInSky, side)), 1e-3); // and not of all of it
}

TEST(PrtHaar, BeatsAsManySphericalHarmonicsOnASmallSun) {
    const Scene scene = edgeUnderSun(sunAlone(5, {0.13, 1, 0.07}));
    Stage stage(scene);
    stage.show(0);
    const double haar = sunRmsError(stage, "prt-haar:n=25,points=4096"), harmonics = sunRmsError(stage, "prt-sh");
    EXPECT_LT(haar, 0.5 * harmonics); // its largest coefficients are where the sun is, 25 harmonics are all over the sky
}

TEST(PrtHaar, AFewCoefficientsDoNotHoldASunInTheMiddleOfAFace) { // where four functions of each scale meet
    const Scene scene = edgeUnderSun(sunAlone(5));
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(sunRmsError(stage, "prt-haar:n=25,points=2000"), 1.5 * sunRmsError(stage, "prt-haar:n=100,points=2000"));
}

TEST(PrtHaar, ErrorFallsWithTheResolution) {
    const Scene scene = edgeUnderSun(sunAlone(5));
    Stage stage(scene);
    stage.show(0);
    EXPECT_LT(sunRmsError(stage, "prt-haar:points=8192,resolution=32,rays=1"),
              sunRmsError(stage, "prt-haar:points=8192,resolution=16,rays=2"));
}

TEST(PrtHaar, ErrorFallsWithTheNumberOfCoefficients) {
    const Scene scene = edgeUnderSun({ConstantSky{0.02}, {{glm::dvec3(0, 1, 0), 5, 40}}});
    Stage stage(scene);
    stage.show(0);
    const auto few = [&](int n) { return rendered(stage, fmt::format("prt-haar:points=4096,resolution=16,n={}", n)); };
    const Image<float> all = few(24576);
    const auto distance = [&](const Image<float>& v) {
        double sum = 0;
        for (std::size_t i = 0; i < v.size(); ++i) sum += std::abs(static_cast<double>(v[i] - all[i]));
        return sum / static_cast<double>(v.size());
    };
    const double five = distance(few(5)), hundred = distance(few(100));
    EXPECT_GT(five, 5 * hundred);
    EXPECT_LT(hundred, 0.01);
}

TEST(PrtHaar, StoresAllCoefficientsWhateverItUses) { // its failure
    const Scene scene = under(boxScene(96), sunInSky);
    Stage stage(scene);
    stage.show(0);
    for (const int side : {16, 32})
        for (const int n : {10, 100}) {
            const auto all = figuresOf(stage, fmt::format("prt-haar:points=1000,threshold=0,resolution={},n={}", side, n));
            EXPECT_EQ(all.at("coefficients"), n);
            EXPECT_EQ(all.at("transfer_bytes"), 6.0 * all.at("points") * 6 * side * side); // a float and its number each
        }
    // Nor is it little once the smallest are left out: prt-sh stores 25 numbers a point.
    const auto few = figuresOf(stage, "prt-haar:points=1000");
    EXPECT_LT(few.at("transfer_bytes"), 0.25 * 6 * few.at("points") * 6 * 64 * 64);
    EXPECT_GT(few.at("transfer_bytes"), 10 * 4 * 25 * few.at("points"));
}

TEST(PrtHaar, WhatIsNotStoredChangesLittle) {
    const Scene scene = edgeUnderSun(sunAlone(5));
    Stage stage(scene);
    stage.show(0);
    const auto slab = [&](const std::string& variant) { return slabPoints(stage, rendered(stage, variant)); };
    const auto all = slab("prt-haar:points=1000,threshold=0"), few = slab("prt-haar:points=1000");
    double worst = 0;
    for (std::size_t i = 0; i < all.size(); ++i) worst = std::max(worst, std::abs(all[i].visibility - few[i].visibility));
    // The sun covers twenty texels of 1/1000 each, a hundred coefficients err by 1/20000 each and with either sign.
    EXPECT_LT(worst, 0.03);
}

TEST(PrtHaar, IsForEnvironmentLightAndSurfacesThatStandStill) {
    const Variant variant = parseVariant("prt-haar");
    EXPECT_EQ(variant.entry->environment, EnvironmentAnswer::Only);
    Scene scene = plateUnderSky();
    EXPECT_FALSE(variant.entry->notApplicable(scene));
    scene.objects[1].motion.degreesPerFrame = 1;
    EXPECT_TRUE(variant.entry->notApplicable(scene));
    EXPECT_THROW(parseVariant("prt-haar:resolution=48"), BadInput);
    EXPECT_THROW(parseVariant("prt-haar:n=0"), BadInput);
}

} // namespace
} // namespace shadowbench
