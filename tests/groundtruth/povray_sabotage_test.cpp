// Every fault that a recipe is known to have is refused, on a scene where it matters; the recipe itself passes there.
#include "base/error.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/oracle.h"
#include "tests/support/certificates.h"
#include "tests/support/povray_scene.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::groundtruth {

using namespace hard;
namespace {

using Lights = povray::Recipe::Lights;

/// The scene of overlapping plates as a model of a few millimetres: all of it is nearer than POV-Ray's least shadow
/// distance.
Snapshot millimetres() {
    constexpr double shrink = 4e-4;
    Snapshot scene = overlappingPlates();
    for (glm::dvec3* vector : {&scene.camera.eye, &scene.camera.target, &scene.light.centre, &scene.light.u, &scene.light.v})
        *vector *= shrink;
    scene.camera.near *= shrink;
    scene.camera.far *= shrink;
    for (Batch& batch : scene.batches)
        for (Placement& placement : batch.placements)
            for (int column = 0; column < 4; ++column) {
                placement.world[column].x *= shrink;
                placement.world[column].y *= shrink;
                placement.world[column].z *= shrink;
            }
    return scene;
}

/// A grating of bars, each seen from the ground before a thirtieth of the light: between the corners of a coarse cell.
Snapshot thinBars() {
    Snapshot scene = overlappingPlates();
    scene.batches.pop_back();
    Batch bars = placed(box({4.0, 0.02, 0.02}), at({0, 2.1, -1.1}), 2);
    for (std::uint32_t i = 1; i < 8; ++i) {
        const glm::dmat4 world = glm::rotate(at({0.1, 2.1, -1.1 + 0.31 * i}), 0.03 * i, glm::dvec3(0, 1, 0));
        bars.placements.push_back({world, world, 2 + i});
    }
    scene.batches.push_back(bars);
    return scene;
}

/// A ground under a light so low that the plane's normal, rounded to single precision as POV-Ray keeps it, has the light
/// behind; the exact plane has all of it in front, and nothing hides it.
Snapshot grazingLight() {
    const glm::dmat4 tilted = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(0.3, 0.5, 0.8)));
    Mesh ground = plane(6);
    for (glm::vec3& p : ground.positions) p = glm::vec3(tilted * glm::dvec4(p, 1));
    const glm::uvec3 corners = ground.triangles[0];
    const glm::dvec3 origin(ground.positions[corners.x]);
    const glm::dvec3 first = glm::dvec3(ground.positions[corners.y]) - origin;
    const glm::dvec3 second = glm::dvec3(ground.positions[corners.z]) - origin;
    const glm::dvec3 normal = glm::normalize(glm::cross(first, second));
    const glm::dvec3 rounding = glm::dvec3(glm::vec3(normal)) - normal;
    const glm::dvec3 away =
        -glm::normalize(rounding - normal * glm::dot(rounding, normal)); // where the rounded plane is too high

    ground.triangles = {corners}; // the other one has a plane of its own
    const glm::dvec3 centre = origin + (first + second) / 3.0;
    Snapshot scene;
    scene.camera = {centre + 3.0 * normal, centre, away, 8, 0.01, 50};
    scene.previousCamera = scene.camera;
    const glm::dvec3 side = glm::cross(normal, away);
    scene.light = {LightKind::Rectangle, centre + 2.5 * away + 1e-8 * normal, -normal, 0.1 * side, 0.1 * away};
    scene.batches.push_back(placed(ground, glm::dmat4(1), 1));
    return scene;
}

struct Sabotage {
    std::string fault;
    Snapshot scene;
    int samples;
    povray::Recipe recipe;
    std::string reason; // a part of the sentence
};

std::vector<Sabotage> sabotages() {
    const std::string wrong = "fully lit or fully shadowed and should not be";
    return {{"UnscaledWorld", millimetres(), 64, {.largestScale = 1}, wrong},
            {"GridOfSix", halfPlane(LightKind::Rectangle), 36, {.lights = Lights::Grid}, "weights are not equal"},
            {"Adaptive", thinBars(), 1024, {.lights = Lights::AdaptiveGrid}, wrong},
            {"NoDoubleIlluminate", grazingLight(), 64, {.doubleIlluminate = false}, wrong}};
}

Certificate certificateOf(const Sabotage& sabotage, const povray::Recipe& recipe) {
    const Request request{sabotage.scene, {64, 64}, Truth::Soft, sabotage.samples};
    const PrimaryHits primary = primaryHits(request.snapshot, request.size);
    povray::Options options;
    options.recipe = recipe;
    const povray::Render image = povray::render(request.snapshot, request.size, request.samples, options);
    return certify(request, image, primary, certificatePointCount, 2);
}

class SabotagedRecipe : public testing::TestWithParam<std::size_t> {};

TEST_P(SabotagedRecipe, IsRejectedWhereTheRecipePasses) {
    const Sabotage sabotage = sabotages()[GetParam()];
    const Certificate bad = certificateOf(sabotage, sabotage.recipe), good = certificateOf(sabotage, {});
    RecordProperty("sabotaged", describe(bad));
    RecordProperty("honest", describe(good));
    EXPECT_NE(rejection(requireCertified, bad, sabotage.samples).find(sabotage.reason), std::string::npos) << describe(bad);
    EXPECT_EQ(rejection(requireCertified, good, sabotage.samples), "") << describe(good);
    EXPECT_GE(good.points, 256);
}

INSTANTIATE_TEST_SUITE_P(Recipes, SabotagedRecipe, testing::Range<std::size_t>(0, 4),
                         [](const auto& parameter) { return sabotages()[parameter.param].fault; });

TEST(Recipe, AGridIsWorseWhereEdgesAreParallelToTheLightsSides) {
    const Sabotage grid{"", halfPlane(LightKind::Rectangle), 64, {}, ""};
    Certificate eight = certificateOf(grid, {.lights = Lights::Grid});
    const Certificate points = certificateOf(grid, {});
    EXPECT_EQ(rejection(requireCertified, points, grid.samples), "") << describe(points);
    EXPECT_NE(rejection(requireCertified, eight, grid.samples).find("what these samples see"), std::string::npos);
    eight.replayed = 0; // were the grid the recipe's own sample set
    EXPECT_NE(rejection(requireCertified, eight, grid.samples).find("rms error"), std::string::npos) << describe(eight);
    EXPECT_NEAR(eight.rms, 0.036, 0.003);    // steps of 1/8 along the edge: 1/(8 √12), known from some 380 points
    EXPECT_LE(points.rms, 0.25 * eight.rms); // steps of 1/64
}

TEST(Recipe, OccludersTooThinForTheSamplesAreNotedBeforeACertificateIsAsked) {
    try {
        compute({thinBars(), {64, 64}, Truth::Soft, povray::fewestLightSamples});
        ADD_FAILURE() << "four samples saw what lies between them";
    } catch (const InternalError& error) {
        EXPECT_NE(std::string(error.what()).find("contradict each other"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("too thin for 4 samples"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace shadowbench::groundtruth
