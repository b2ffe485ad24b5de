// The exact share of a sky's irradiance against closed forms.
#include "base/error.h"
#include "groundtruth/certify/sky_certificate.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "tests/support/area_scenes.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace shadowbench::groundtruth::testing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSampling =
    1e-3;                    // of 16,384 low-discrepancy directions, half of which are above the plane; seen: a third of it
constexpr float kFar = 4000; // metres: what ends there hides all but 10⁻³ of a tangent

const EnvironmentLight kConstant{ConstantSky{1}, {}};

EnvironmentLight sunAlone(const glm::dvec3& direction, double diameter) {
    return {ConstantSky{0}, {Sun{glm::normalize(direction), diameter, 7}}};
}

/// A ground at y = 0; what hides the sky is added to it.
SceneBuilder ground() {
    SceneBuilder scene;
    scene.add(plane(8));
    return scene;
}

/// A vertical rectangle from (x0, z0) to (x1, z1) on the ground.
Mesh wall(float x0, float z0, float x1, float z1, float height) {
    return {{{x0, 0, z0}, {x1, 0, z1}, {x1, height, z1}, {x0, height, z0}}, {{0, 1, 2}, {0, 2, 3}}, false};
}

Irradiance irradianceAt(const Snapshot& seen, const EnvironmentLight& light, double& share) {
    const glm::ivec2 size(1, 1);
    const auto triangles = std::make_shared<const geometry::SceneTriangles>(seen);
    const PrimaryHits primary = primaryHits(seen, size);
    const ExactSky sky(seen, triangles);
    share = exactSkyShare(sky, light, primary)({0, 0}).low;
    std::vector<SkyDirection> directions;
    const SkySampler sampler(light);
    for (int i = 0; i < 128; ++i)
        for (int j = 0; j < 128; ++j) {
            directions.push_back(sampler.at(0, {(i + 0.5) / 128, (j + 0.5) / 128}));
            directions.back().irradiance /= 128 * 128;
        }
    return sky.irradiance({0, 0}, primary, directions);
}

/// Of a point of an upward surface.
double shareAt(SceneBuilder& scene, const glm::dvec3& point, const EnvironmentLight& light) {
    scene.get().light = environmentLight(light);
    double share = 0;
    irradianceAt(looksDownOn(scene.get(), point), light, share);
    return share;
}

TEST(ExactSky, OpenGroundGetsAllOfIt) {
    SceneBuilder scene = ground();
    EXPECT_EQ(shareAt(scene, {0.3, 0, 0.1}, kConstant), 1);
    EXPECT_EQ(shareAt(scene, {0.3, 0, 0.1}, sunAlone({1, 1, 0}, 5)), 1);
    EXPECT_EQ(shareAt(scene, {0.3, 0, 0.1}, {HarmonicSky{{3, 1, 0.5, 0}}, {Sun{{0.6, 0.8, 0}, 20, 3}}}), 1);
}

TEST(ExactSky, WhatLiesBelowTheTangentPlaneCountsNowhere) {
    const glm::dmat4 tilted = glm::rotate(glm::dmat4(1), glm::radians(40.0), glm::dvec3(1, 0, 0));
    SceneBuilder scene;
    scene.add(plane(8), {tilted});
    const glm::dvec3 point(tilted * glm::dvec4(0.2, 0, 0.1, 1)), normal(tilted[1]);
    Snapshot seen = scene.get();
    seen.camera = {point + 0.01 * normal, point, {1, 0, 0}, 45, 0x1p-12, 60};
    double share = 0;
    const Irradiance whole = irradianceAt(seen, kConstant, share);
    EXPECT_EQ(share, 1);
    EXPECT_NEAR(whole.unoccluded, kPi, 2e-3); // the upper half alone: ∫ cos θ dω
    EXPECT_EQ(whole.arriving, whole.unoccluded);

    // A sun at the plane's horizon: half of it is above.
    const glm::dvec3 level(tilted[2]);
    const double radius = glm::radians(5.0);
    EXPECT_NEAR(irradianceAt(seen, sunAlone(level, 10), share).unoccluded,
                7 * (radius - std::sin(radius) * std::cos(radius)), 2e-5);
    EXPECT_EQ(irradianceAt(seen, sunAlone(-normal, 10), share).unoccluded, 0);
}

TEST(ExactSky, AnEndlessWallHidesHalfTheSkyBesideItsFoot) {
    for (const double distance : {0.25, 1.0, 3.0}) {
        SceneBuilder scene = ground();
        scene.add(wall(1, -kFar, 1, kFar, 2));
        // The sky above elevation φ in every plane across the wall: ½ (1 + cos φ).
        const double cosine = distance / std::hypot(distance, 2);
        EXPECT_NEAR(shareAt(scene, {1 - distance, 0, 0}, kConstant), 0.5 * (1 + cosine), kSampling) << distance;
    }
    SceneBuilder scene = ground();
    scene.add(wall(1, -kFar, 1, kFar, kFar));
    EXPECT_NEAR(shareAt(scene, {0, 0, 0}, kConstant), 0.5, kSampling);
}

TEST(ExactSky, AHalfPlaneOverheadHidesWhatIsBeyondItsEdge) {
    for (const double x : {-2.0, -0.5, 0.0, 1.0}) { // of the edge, from the point
        SceneBuilder scene = ground();
        scene.add(plate(static_cast<float>(x), kFar, 1, -kFar, kFar));
        EXPECT_NEAR(shareAt(scene, {0, 0, 0}, kConstant), 0.5 * (1 + x / std::hypot(x, 1)), kSampling) << x;
    }
}

TEST(ExactSky, ACornerOfEndlessWallsLeavesAQuarter) {
    SceneBuilder scene = ground();
    scene.add(wall(1, -kFar, 1, kFar, kFar)).add(wall(-kFar, 1, kFar, 1, kFar));
    EXPECT_NEAR(shareAt(scene, {0, 0, 0}, kConstant), 0.25, kSampling);
}

TEST(ExactSky, OfASmallSunItIsTheVisibleShareOfItsDisk) {
    constexpr double kDiameter = 2;
    const double radius = std::sin(glm::radians(0.5 * kDiameter));
    for (const double t : {-0.8, -0.3, 0.0, 0.5, 0.9}) { // of the edge from the disk's centre, in radii
        SceneBuilder scene = ground();
        const double slope = t * radius / std::sqrt(1 - t * t * radius * radius);
        scene.add(plate(static_cast<float>(100 * slope), kFar, 100, -kFar, kFar));
        const double hidden = (std::acos(t) - t * std::sqrt(1 - t * t)) / kPi; // the segment of a disk beyond a chord
        EXPECT_NEAR(shareAt(scene, {0, 0, 0}, sunAlone({0, 1, 0}, kDiameter)), 1 - hidden, kSampling) << t;
    }
}

TEST(ExactSky, AnOccluderThatSeesAPartOfTheLightHidesItsShareOnly) {
    SceneBuilder scene = ground();
    scene.add(plate(-1, 1, 1, -1, 1)); // over the point: of a constant sky the form factor of the plate
    const double side = std::sqrt(2.0), factor = 4 / (2 * kPi) * 2 * (1 / side * std::atan(1 / side)); // four quarters
    EXPECT_NEAR(shareAt(scene, {0, 0, 0}, kConstant), 1 - factor, kSampling);
    EXPECT_EQ(shareAt(scene, {0, 0, 0}, sunAlone({0, 1, 0}, 10)), 0);
    EXPECT_EQ(shareAt(scene, {0, 0, 0}, sunAlone({3, 1, 0}, 10)), 1);
    // A sky of irradiance π and a sun of irradiance s, the sun hidden: what is left of the sky alone.
    EnvironmentLight both{ConstantSky{1}, {Sun{{0, 1, 0}, 10, 40}}};
    const double sun = 40 * kPi * std::pow(std::sin(glm::radians(5.0)), 2);
    EXPECT_NEAR(shareAt(scene, {0, 0, 0}, both), kPi * (1 - factor) / (kPi + sun), 3 * kSampling); // half the directions
}

TEST(ExactSky, KnowsTheNormalsThatThePixelsSee) {
    SceneBuilder scene = ground();
    scene.add(wall(1, -5, 1, 5, 2));
    scene.get().camera = {{-4, 3, 0}, {1, 0.5, 0}, {0, 1, 0}, 60, 0.1, 60};
    const geometry::SceneTriangles triangles(scene.get());
    const PrimaryHits primary = primaryHits(scene.get(), {32, 32});
    const Image<glm::dvec3> normals = seenNormals(scene.get(), triangles, primary);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 expected = primary.id[i] == 0   ? glm::dvec3(0)
                                    : primary.id[i] == 1 ? glm::dvec3(0, 1, 0)
                                                         : glm::dvec3(-1, 0, 0); // the side of the eye
        EXPECT_EQ(normals[i], expected) << i;
    }
}

TEST(ExactSky, HasNoAnswerWhereThereIsNoSurface) {
    Snapshot empty;
    empty.camera = {{0, 1, 0}, {0, 1, -1}, {0, 1, 0}, 45, 0.1, 60};
    const auto triangles = std::make_shared<const geometry::SceneTriangles>(empty);
    EXPECT_THROW(static_cast<void>(ExactSky(empty, triangles).irradiance({0, 0}, primaryHits(empty, {1, 1}), {})),
                 InternalError);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
