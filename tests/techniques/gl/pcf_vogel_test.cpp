// The Vogel disk and interleaved gradient noise against their formulas, and PCF over them against the ramp of a disk.
#include "tests/support/bands.h"
#include "tests/support/rows_over_frames.h"
#include "tests/support/shader_function.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

const std::string chunk = "shared/sampling/vogel.glsl";

/// All taps of a disk of n.
std::vector<glm::dvec2> diskOf(int n, double turn = 0) {
    std::vector<glm::vec4> inputs;
    for (int i = 0; i < n; ++i) inputs.emplace_back(i, n, turn, 0);
    std::vector<glm::dvec2> taps;
    for (const glm::vec4& tap : evaluated(chunk, "vec4(vogelTap(int(x.x), int(x.y), x.z), 0.0, 0.0)", inputs))
        taps.emplace_back(tap.x, tap.y);
    return taps;
}

TEST(VogelDisk, TapsLieAtEqualStepsOfAreaAndOfTheGoldenAngle) {
    constexpr int n = 21;
    constexpr double turn = 0.7;
    const double golden = glm::pi<double>() * (3 - std::sqrt(5.0));
    const auto taps = diskOf(n, turn);
    for (int i = 0; i < n; ++i) {
        const double radius = std::sqrt((i + 0.5) / n), angle = i * golden + turn;
        EXPECT_NEAR(taps[i].x, radius * std::cos(angle), 1e-5) << i;
        EXPECT_NEAR(taps[i].y, radius * std::sin(angle), 1e-5) << i;
    }
}

TEST(VogelDisk, IsAsDenseInTheMiddleAsAtTheRim) {
    constexpr int n = 512;
    const auto taps = diskOf(n);
    for (const double radius : {0.25, 0.5, 0.75, 0.9}) {
        const auto within = std::ranges::count_if(taps, [&](const glm::dvec2& tap) { return glm::length(tap) < radius; });
        EXPECT_NEAR(static_cast<double>(within), n * radius * radius, 1) << radius;
    }
    double square = 0;
    glm::dvec2 mean(0);
    for (const glm::dvec2& tap : taps) {
        square += tap.x * tap.x / n;
        mean += tap / static_cast<double>(n);
    }
    EXPECT_NEAR(square, 0.25, 0.003); // of a disk, as of any diameter
    EXPECT_LT(glm::length(mean), 0.003);
}

double modelNoise(double x, double y) { return glm::fract(52.9829189 * glm::fract(0.06711056 * x + 0.00583715 * y)); }

TEST(GradientNoise, IsItsFormula) {
    std::vector<glm::vec4> pixels;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) pixels.emplace_back(x + 0.5, y + 0.5, 0, 0);
    const auto noise =
        evaluated(chunk, "vec4(gradientNoise(x.xy), gradientNoise(x.xy, 67, 1), gradientNoise(x.xy, 0, 2), 0.0)", pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::dvec2 at(pixels[i].x, pixels[i].y), later = at + 3 * 5.588238; // of 64 frames the 67th is the third
        const auto around = [](double a, double b) { return std::abs(glm::fract(a - b + 0.5) - 0.5); };
        EXPECT_LT(around(noise[i].x, modelNoise(at.x, at.y)), 1e-4);
        EXPECT_LT(around(noise[i].y, modelNoise(later.x, later.y)), 2e-4);
        EXPECT_LT(around(noise[i].z, modelNoise(at.x + 23, at.y + 41)), 2e-4);
    }
}

TEST(GradientNoise, SpreadsEvenlyOverAnyThreeByThreePixels) { // what it is made for
    double widest = 0;
    for (int top = 0; top < 40; ++top)
        for (int left = 0; left < 40; ++left) {
            std::vector<double> values;
            for (int i = 0; i < 9; ++i) values.push_back(modelNoise(left + i % 3 + 0.5, top + i / 3 + 0.5));
            std::ranges::sort(values);
            values.push_back(values.front() + 1);
            for (std::size_t i = 0; i + 1 < values.size(); ++i) widest = std::max(widest, values[i + 1] - values[i]);
        }
    EXPECT_LT(widest, 2.0 / 9); // nine values of equal steps are 1/9 apart
}

constexpr int map = 128; // texels of 9 cm of ground, of which a pixel sees about one: bands show

BandsAndNoise measured(const Scene& scene, Stage& stage, const Image<float>& image, double reach) {
    return bandsAndNoise(groundPoints(stage, image), mapEdge(stage, map), reach * texelOf(scene, map), diskShare,
                         static_cast<int>(std::lround(12 * reach)));
}

TEST(PcfVogel, FramesAverageToTheDisksRamp) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const auto row = rowOf("pcf-vogel:radius=6,map=128");
    const BandsAndNoise one = measured(scene, stage, imageAfter(stage, *row, 1), 6);
    const BandsAndNoise many = measured(scene, stage, meanOver(stage, *row, 64), 6);
    EXPECT_LT(many.worstMean, 0.02);
    EXPECT_LT(many.noise, 0.02);
    EXPECT_GT(one.noise, 5 * many.noise); // five taps alone
}

TEST(PcfVogel, WithoutATurnItsErrorIsBands) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const BandsAndNoise still = measured(scene, stage, imageAfter(stage, "pcf-vogel:radius=6,turn=none,map=128", 1), 6);
    const BandsAndNoise turned = measured(scene, stage, imageAfter(stage, "pcf-vogel:radius=6,turn=pixel,map=128", 1), 6);
    EXPECT_GT(still.bands, 3 * turned.bands);
    EXPECT_GT(turned.noise, 3 * still.noise);
}

TEST(PcfVogel, OnlyFramesTurnWhatStandsStill) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const auto changed = [&](const std::string& variant) {
        const auto row = rowOf(variant);
        const Image<float> first = imageAfter(stage, *row, 1);
        return rmsDifference(first, imageAfter(stage, *row, 2));
    };
    EXPECT_EQ(changed("pcf-vogel:radius=6,turn=pixel,map=128"), 0);
    EXPECT_GT(changed("pcf-vogel:radius=6,map=128"), 0.01);
}

} // namespace
} // namespace shadowbench
