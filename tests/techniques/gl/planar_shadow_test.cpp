// Planar shadows against closed forms on their receiver, and what they leave out.
#include "harness/cells/cell.h"
#include "techniques/catalog.h"
#include "techniques/planar/planar_receiver.h"
#include "tests/support/ground_labels.h"
#include "tests/support/shader_function.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using techniques::planarReceiver;

TEST(PlanarReceiver, IsTheFloorWhateverElseIsLarger) {
    const Scene scene = halfPlaneScene(); // its plate is larger than the slab, but hangs over it
    const auto receiver = planarReceiver(snapshot(scene, 0));
    ASSERT_TRUE(receiver.has_value());
    EXPECT_EQ(receiver->id, 1U);
    EXPECT_LT(glm::distance(glm::dvec3(receiver->plane), glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_NEAR(receiver->plane.w, 0, 1e-8); // 0.1 as a float is 1.5·10⁻⁹ off
}

TEST(PlanarReceiver, IsMissingWhereNothingIsFlat) {
    Scene scene = groundScene();
    scene.objects = {object(sphere(1, 320), {0, 0, 0}), object(bumpy(1, 0.2, 320, 2), {3, 0, 0})};
    EXPECT_FALSE(planarReceiver(snapshot(scene, 0)).has_value());
    for (const char* variant : {"planar-hard", "planar-fake"}) {
        const auto reason = notApplicable(scene, techniques::parseVariant(variant));
        ASSERT_TRUE(reason.has_value()) << variant;
        EXPECT_EQ(reason->find("needs a planar receiver"), 0U) << *reason;
    }
    EXPECT_FALSE(notApplicable(scene, techniques::parseVariant("sm-uniform")).has_value());
}

TEST(PlanarReceiver, FacesTheLight) {
    Scene scene = boxScene();
    scene.light.centre = {0, -5, 0}; // under the slab, which shades the box's lower side
    const auto receiver = planarReceiver(snapshot(scene, 0));
    ASSERT_TRUE(receiver.has_value());
    EXPECT_EQ(receiver->id, 2U);
    EXPECT_LT(glm::distance(glm::dvec3(receiver->plane), glm::dvec3(0, -1, 0)), 1e-12);
}

TEST(ProjectionOntoAPlane, PutsAPointOnThePlaneAndOnItsRayFromTheLight) { // Zápotocký, eq. 2.3
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 1, -0.2));
    const glm::dvec4 plane(normal, 0.7);
    const glm::dvec3 light(2, 7, 1), point(0.4, 2, -0.6);
    const glm::dvec4 h = techniques::projectionOnto(plane, glm::dvec4(light, 1)) * glm::dvec4(point, 1);
    const glm::dvec3 shadow = glm::dvec3(h) / h.w;
    EXPECT_NEAR(glm::dot(plane, glm::dvec4(shadow, 1)), 0, 1e-12);
    EXPECT_LT(glm::length(glm::cross(glm::normalize(shadow - light), glm::normalize(point - light))), 1e-12);
    EXPECT_GT(h.w, 0);
    const glm::dvec4 beyond = techniques::projectionOnto(plane, glm::dvec4(light, 1)) * glm::dvec4(0, 20, 0, 1);
    EXPECT_LT(beyond.w, 0); // nearer to the light's side than the light: would be thrown back
}

TEST(PlanarHard, ABoxsShadowIsTheExactPolygonToATwentiethOfAPixel) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const GroundLabels labels = compareOnGround(scene, stage, rendered(stage, "planar-hard"), behindBox(scene));
    EXPECT_GT(labels.dark, 1000U);
    EXPECT_EQ(labels.mismatch(), 0);
}

TEST(PlanarHard, HoldsUnderADirectionalLightAndForCastersBehindTheEye) {
    Scene scene = boxScene(128);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(-0.1, -1, -0.4));
    scene.light = {LightKind::Directional, {}, direction, {}, {}};
    scene.camera.eye = {0.1, 0.5, 0.3}; // the box is above and behind
    scene.camera.target = {-0.1, 0, -2};
    scene.camera.near = 0.01;
    Stage stage(scene);
    stage.show(0);
    const auto shadowed = [&](const glm::dvec3& p) { return meetsBox(p, p - 1e4 * direction); };
    const GroundLabels labels = compareOnGround(scene, stage, rendered(stage, "planar-hard"), shadowed);
    EXPECT_GT(labels.dark, 100U);
    EXPECT_EQ(labels.mismatch(), 0);
}

TEST(PlanarHard, WhatStandsBeyondTheLightCastsNothing) {
    Scene scene = boxScene(128);
    scene.objects.push_back(object(box({2, 0.2, 2}), {1.7, 8, -2.3})); // above the light
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(compareOnGround(scene, stage, rendered(stage, "planar-hard"), behindBox(scene)).mismatch(), 0);
}

TEST(PlanarHard, ShadesNothingButItsPlane) { // Zápotocký, Table 2.1
    Scene scene = boxScene(128);
    scene.objects.push_back(object(box({0.9, 0.3, 0.8}), {0, 0.2, 0.4})); // in the shadow of the box above it
    Stage stage(scene);
    stage.show(0);
    const Image<float> planar = rendered(stage, "planar-hard"), volumes = rendered(stage, "volume-zfail");
    const metrics::Drawn drawn = stage.drawn();
    std::size_t missing = 0;
    for (std::size_t i = 0; i < planar.size(); ++i) {
        if (drawn.id[i] != 3) continue;
        EXPECT_EQ(planar[i], 1.0F);
        missing += volumes[i] == 0.0F ? 1 : 0;
    }
    EXPECT_GT(missing, 100U);
}

double softError(Stage& stage, int samples) {
    const Image<float> v = rendered(stage, "planar-soft:n=" + std::to_string(samples));
    const metrics::Drawn drawn = stage.drawn();
    double sum = 0;
    std::size_t penumbra = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (drawn.id[i] != 1 || drawn.position[i].y < -0.001F) continue;
        const double truth = halfPlaneVisibility(glm::dvec3(drawn.position[i]));
        if (truth <= 0 || truth >= 1) continue;
        sum += (v[i] - truth) * (v[i] - truth);
        ++penumbra;
    }
    EXPECT_GT(penumbra, 500U);
    return std::sqrt(sum / static_cast<double>(penumbra));
}

TEST(PlanarSoft, ConvergesToTheVisibleFractionAsSamplesGrow) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    // The edge is at right angles to the light's regular coordinate: N samples make N even steps, of rms 1/√12 each.
    for (const int samples : {16, 64, 256}) {
        const double error = softError(stage, samples);
        EXPECT_GT(error, 0.5 / std::sqrt(12.0) / samples) << samples;
        EXPECT_LT(error, 1.5 / std::sqrt(12.0) / samples) << samples;
    }
}

TEST(PlanarSoft, DrawsTheSceneOnceASample) { // cost is linear in N
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto drawsOf = [&](const char* variant) {
        const std::uint64_t before = testContext().tally().draws;
        rendered(stage, variant);
        return testContext().tally().draws - before;
    };
    EXPECT_EQ(drawsOf("planar-soft:n=100") - drawsOf("planar-soft:n=64"), 36U * 2); // two meshes
}

TEST(PlanarFake, ItsPenumbraIsOneWidthWhateverTheHeightOfTheCaster) { // Zápotocký 5.2: the kernel's, not the light's
    for (const double height : {0.7, 2.0, 3.9}) {
        Scene scene = halfPlaneScene(128);
        scene.objects.back() = object(box({20, 0.002, 40}), {10.3, height + 0.001, 0});
        Stage stage(scene);
        stage.show(0);
        const Image<float> v = rendered(stage, "planar-fake:map=128");
        const metrics::Drawn drawn = stage.drawn();
        constexpr double kernel = 7 * 12.0 / 128;                 // metres on the slab
        const double edge = 0.1 + (0.3 - 0.1) * 6 / (6 - height); // of the shadow from the light's centre
        std::size_t grey = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (drawn.id[i] != 1 || drawn.position[i].y < -0.001F) continue;
            const double inside = edge - static_cast<double>(drawn.position[i].x);
            const double ramp = std::clamp(0.5 + inside / kernel, 0.0, 1.0);
            // The texture's edge lies within half a texel of the shadow's, a 14th of the ramp; bilinear lookups round its
            // ends by as much again.
            EXPECT_NEAR(v[i], ramp, 2.0 / 14) << "height " << height << ", " << inside << " m inside";
            grey += v[i] > 0 && v[i] < 1 ? 1 : 0;
        }
        EXPECT_GT(grey, 300U) << height;
    }
}

// 7×7 bilinear lookups, of which the shader makes 4×4.
TEST(PlanarFake, ItsMeanIsThatOfTheThesisLookups) {
    constexpr int side = 32;
    Image<std::uint8_t> texels(side, side);
    std::uint32_t state = 7;
    for (std::uint8_t& texel : texels) {
        state = state * 1664525U + 1013904223U;
        texel = (state >> 30U) == 0 ? 0 : 255;
    }
    const auto bilinear = [&](double x, double y) { // in texels
        double sum = 0;
        const double left = std::floor(x - 0.5), low = std::floor(y - 0.5);
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                const int column = std::clamp(static_cast<int>(left) + i, 0, side - 1);
                const int row = std::clamp(static_cast<int>(low) + j, 0, side - 1);
                sum += (1 - std::abs(x - 0.5 - left - i)) * (1 - std::abs(y - 0.5 - low - j)) * texels(column, row) / 255.0;
            }
        return sum;
    };
    testContext();
    gl::Texture image(gl::Format::R8, {side, side}, gl::Filter::Linear);
    image.upload(texels);
    std::vector<glm::vec4> points;
    for (double x = 0.01; x < 1; x += 0.0937)
        for (double y = 0.02; y < 1; y += 0.0717) points.emplace_back(x, y, 0, 0);
    for (const int kernel : {3, 7, 9}) {
        const auto means = evaluated("planar/planar-fake/box.glsl", "boxMean(x.xy)", points,
                                     {{"KERNEL", std::to_string(kernel)}}, [&](gl::Program& p) { p.set("shadow", image); });
        for (std::size_t i = 0; i < points.size(); ++i) {
            double sum = 0;
            for (int y = 0; y < kernel; ++y)
                for (int x = 0; x < kernel; ++x)
                    sum += bilinear(side * static_cast<double>(points[i].x) + x - 0.5 * (kernel - 1),
                                    side * static_cast<double>(points[i].y) + y - 0.5 * (kernel - 1));
            EXPECT_NEAR(means[i].x, sum / (kernel * kernel), 1.0 / 255) << kernel; // weights and values of 8 bits
        }
    }
}

} // namespace
} // namespace shadowbench
