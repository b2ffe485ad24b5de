// POV-Ray against closed forms.
#include "groundtruth/povray/povray.h"
#include "tests/support/povray_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <utility>

namespace shadowbench::groundtruth {
namespace {

constexpr glm::ivec2 size{64, 64};

/// Where the ray through a pixel centre meets the ground.
glm::dvec3 ground(const Camera& camera, int x, int y) {
    const glm::dvec3 ray = camera.ray({x + 0.5, y + 0.5}, size);
    return camera.eye - camera.eye.y / ray.y * ray;
}

/// Visible share of the half-plane scene's light from ground position x: the part with light coordinate below −2x.
double truth(LightKind kind, double x) {
    const double edge = std::clamp(-2 * x, -1.0, 1.0);
    if (kind != LightKind::Disk) return 0.5 * (edge + 1);
    return 0.5 + (edge * std::sqrt(1 - edge * edge) + std::asin(edge)) / std::numbers::pi;
}

struct Errors {
    double rms = 0;       // over the penumbra
    double mean = 0;      // signed, over the penumbra
    int penumbra = 0;     // its pixels
    int outsideWrong = 0; // umbra or lit pixels that are not exactly 0 or 1
};

Errors measuredErrors(LightKind kind, int samples) {
    const Snapshot scene = halfPlane(kind);
    const povray::Render image = povray::render(scene, size, samples);
    Errors result;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const double position = ground(scene.camera, x, y).x;
            const double expected = truth(kind, position);
            const double error = image.visible(x, y) - expected;
            if (std::abs(position) < 0.5) {
                ++result.penumbra;
                result.rms += error * error;
                result.mean += error;
            } else {
                result.outsideWrong += image.visible(x, y) != static_cast<float>(expected);
            }
        }
    }
    result.rms = std::sqrt(result.rms / result.penumbra);
    result.mean /= result.penumbra;
    return result;
}

/// Rendered once for all tests.
const Errors& errors(LightKind kind, int samples) {
    static std::map<std::pair<LightKind, int>, Errors> known;
    const auto found = known.find({kind, samples});
    if (found != known.end()) return found->second;
    return known.emplace(std::pair{kind, samples}, measuredErrors(kind, samples)).first->second;
}

class HalfPlane : public testing::TestWithParam<LightKind> {};

TEST_P(HalfPlane, HasThePenumbraOfTheClosedForm) {
    const Errors e = errors(GetParam(), 1024);
    RecordProperty("rms", std::to_string(e.rms));
    RecordProperty("mean", std::to_string(e.mean));
    ASSERT_GT(e.penumbra, 1000);
    EXPECT_LE(e.rms, 0.003);             // what a reference may err at 1,024 samples; a regular grid errs several times more
    EXPECT_LE(std::abs(e.mean), 0.0003); // bias: a tenth of that
    EXPECT_EQ(e.outsideWrong, 0);        // umbra exactly 0, unoccluded exactly 1
}

INSTANTIATE_TEST_SUITE_P(Lights, HalfPlane, testing::Values(LightKind::Rectangle, LightKind::Disk, LightKind::Line),
                         [](const auto& parameter) { return std::string(name(parameter.param)); });

TEST(PovRay, ErrorAtLeastHalvesFromTwoHundredFiftySixSamplesToAThousand) {
    EXPECT_LE(errors(LightKind::Rectangle, 1024).rms, 0.5 * errors(LightKind::Rectangle, 256).rms);
}

TEST(PovRay, CountsThatAreNoPowerOfTwoGiveExactFractions) {
    const povray::Render image = povray::render(halfPlane(LightKind::Rectangle), size, 101);
    int penumbra = 0;
    for (const float value : image.visible) {
        const double count = 101.0 * value;
        EXPECT_NEAR(count, std::rint(count), 1e-5); // a float's rounding of k/101
        penumbra += value > 0 && value < 1;
    }
    EXPECT_GT(penumbra, 1000);
}

TEST(PovRay, PartsOfTheSetAreWhatFewerSamplesSee) {
    const povray::Render image = povray::render(halfPlane(LightKind::Disk), size, 256);
    int differ = 0;
    for (std::size_t i = 0; i < image.visible.size(); ++i) {
        const float quarter = image.firstQuarter[i], half = image.firstHalf[i], all = image.visible[i];
        const float secondQuarter = 2 * half - quarter, secondHalf = 2 * all - half;
        ASSERT_TRUE(secondQuarter >= 0 && secondQuarter <= 1 && secondHalf >= 0 && secondHalf <= 1);
        EXPECT_EQ(64 * quarter, std::rint(64 * quarter));
        EXPECT_EQ(128 * half, std::rint(128 * half));
        differ += quarter != secondQuarter && quarter != secondHalf;
    }
    EXPECT_GT(differ, 100); // three sample sets, not one counted thrice
}

TEST(PovRay, SameSceneGivesTheSamePixelsOnAnyThreadCount) {
    const Snapshot scene = overlappingPlates();
    const povray::Render one = povray::render(scene, size, 128, {.threads = 1});
    const povray::Render again = povray::render(scene, size, 128, {.threads = 1});
    const povray::Render four = povray::render(scene, size, 128, {.threads = 4});
    EXPECT_EQ(one.visible, again.visible);
    EXPECT_EQ(one.visible, four.visible);
    EXPECT_EQ(one.hit, four.hit);
}

TEST(PovRay, APlacementMatrixEqualsBakedVertices) {
    // Turned by 90° and shifted by binary fractions: the baked floats are exact, so the images must be equal to the sample.
    glm::dmat4 world(0);
    world[0] = {0, 0, -2, 0};
    world[1] = {0, 1, 0, 0};
    world[2] = {0.5, 0, 0, 0};
    world[3] = {0.25, 1.125, -0.5, 1};
    const Mesh mesh = box({1.0, 0.25, 1.5});
    Mesh baked = mesh;
    for (glm::vec3& p : baked.positions) p = glm::vec3(world * glm::dvec4(p, 1));

    Snapshot placedOne = overlappingPlates(), bakedOne = overlappingPlates();
    placedOne.batches.back() = placed(mesh, world, 2);
    bakedOne.batches.back() = placed(baked, glm::dmat4(1), 2);
    const povray::Render a = povray::render(placedOne, size, 256), b = povray::render(bakedOne, size, 256);
    EXPECT_EQ(a.hit, b.hit);
    int differing = 0, shadowed = 0;
    for (std::size_t i = 0; i < a.visible.size(); ++i) {
        differing += a.visible[i] != b.visible[i];
        shadowed += a.visible[i] < 1;
    }
    EXPECT_GT(shadowed, 100);
    EXPECT_LE(differing, 1); // a ray through an edge may fall either way after the inverse transform
}

TEST(PovRay, RowZeroIsTheTopAndNothingIsMirrored) {
    // One small plate off every axis: its pixels are where Camera::project puts its centre.
    Snapshot scene = overlappingPlates();
    const glm::dvec3 centre{1.1, 0.7, 0.9};
    scene.batches.clear();
    scene.batches.push_back(placed(box({0.3, 0.3, 0.3}), at(centre), 1));
    const povray::Render image = povray::render(scene, size, 16);
    glm::dvec2 sum(0);
    int count = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (image.hit(x, y) != 0) sum += glm::dvec2(x + 0.5, y + 0.5), ++count;
    ASSERT_GT(count, 10);
    const glm::dvec3 expected = scene.camera.project(centre, size);
    EXPECT_GT(glm::distance(glm::dvec2(expected), glm::dvec2(32, 32)), 8.0); // so that a mirrored image would be far off
    EXPECT_NEAR(sum.x / count, expected.x, 0.5);                             // a box's silhouette is centred to half a pixel
    EXPECT_NEAR(sum.y / count, expected.y, 0.5);
}

TEST(PovRayScale, IsThePowerOfTwoThatKeepsTheWorldInRange) {
    Snapshot scene = overlappingPlates();
    EXPECT_EQ(povray::scaleOf(scene), 1024);
    scene.light.centre = {0, 1e5, 0};
    EXPECT_EQ(povray::scaleOf(scene), 64); // 128 · 10⁵ would exceed 10⁷
}

} // namespace
} // namespace shadowbench::groundtruth
