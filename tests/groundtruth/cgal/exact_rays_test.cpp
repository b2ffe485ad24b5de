#include "base/error.h"
#include "scene/meshes/primitives.h"
#include "tests/support/exact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowbench::groundtruth::testing {

using namespace hard;
namespace {

/// By how much the ray from `p` along `way` passes through the box [low, high] (in parameter): positive if it does.
double throughBox(const glm::dvec3& p, const glm::dvec3& way, const glm::dvec3& low, const glm::dvec3& high) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - p[axis]) / way[axis], b = (high[axis] - p[axis]) / way[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return leave - enter;
}

/// Every ground pixel against the slab test of a floating box.
void expectBoxShadow(SceneBuilder& scene, const glm::dvec3& boxSize, const glm::dvec3& centre) {
    constexpr glm::ivec2 size(96, 96);
    scene.add(plane(20)).add(box(boxSize), {at(centre.x, centre.y, centre.z)}).camera({3, 4, 7}, {0, 0.5, 0});
    const Snapshot& snapshot = scene.get();
    const ExactScene exact(snapshot);
    const PrimaryHits primary = exact.primaryHits(size);
    const Reference labels = rayLabels(exact, size, primary);
    std::size_t shadowed = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (primary.id(x, y) != 1) continue;
            const glm::dvec3 p = groundPoint(snapshot.camera, x, y, size);
            const glm::dvec4 light = snapshot.light.homogeneous();
            const glm::dvec3 way = light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - p;
            const double through = throughBox(p, way, centre - 0.5 * boxSize, centre + 0.5 * boxSize);
            ASSERT_GT(std::abs(through), 1e-12) << "the closed form itself is undecided at " << x << ", " << y;
            ASSERT_EQ(labels.visibility(x, y), through > 0 ? 0.0F : 1.0F) << x << ", " << y;
            shadowed += through > 0;
        }
    EXPECT_GT(shadowed, 200U);
}

TEST(ExactRays, ABoxUnderAPointLightCastsItsClosedFormShadow) {
    SceneBuilder scene;
    expectBoxShadow(scene.pointLight({1.3, 5.1, 0.7}), {2, 0.5, 1.25}, {0.25, 1.5, -0.125});
}

TEST(ExactRays, ABoxUnderADirectionalLightCastsItsClosedFormShadow) {
    SceneBuilder scene;
    expectBoxShadow(scene.directionalLight(glm::normalize(glm::dvec3(0.31, -1, 0.17))), {2, 0.5, 1.25}, {0.25, 1.5, -0.125});
}

TEST(ExactRays, AnOccluderBeyondTheLightCastsNoShadow) {
    constexpr glm::ivec2 size(32, 32);
    SceneBuilder scene;
    scene.add(plane(20)).add(plate(-9, 9, 5, -9, 9)).pointLight({0, 4, 0}).cameraAbove(3);
    const ExactScene exact(scene.get());
    const PrimaryHits primary = exact.primaryHits(size);
    const Reference labels = rayLabels(exact, size, primary);
    for (const float v : labels.visibility) EXPECT_EQ(v, 1.0F);
}

/// Eye and light on the y axis, a square image of odd size: the middle row, column and diagonals lie exactly in x = 0, z =
/// 0, x = ±z.
constexpr glm::ivec2 odd(33, 33);

TEST(ExactRays, CentresExactlyOnAShadowEdgeAreNeitherLitNorShadowed) {
    SceneBuilder scene;
    scene.add(plane(20)).add(plate(0, 0.5F, 3, -4, 4)).pointLight({0, 4, 0}).cameraAbove(2);
    const ExactScene exact(scene.get());
    const Reference labels = rayLabels(exact, odd, exact.primaryHits(odd));
    for (int y = 0; y < odd.y; ++y)
        for (int x = 0; x < odd.x; ++x) {
            const int middle = odd.x / 2;
            ASSERT_EQ(labels.surface(x, y), x == middle ? Surface::OnEdge : Surface::Receiver) << x << ", " << y;
            if (x == middle) continue;
            ASSERT_EQ(labels.visibility(x, y), x < middle ? 1.0F : 0.0F) << x << ", " << y;
        }
}

TEST(ExactRays, SegmentsThroughEdgesAndVerticesInsideASurfaceAreBlocked) {
    // The top and bottom diagonals of the box, and the corner in which four plates meet, lie on the segments of many
    // centres.
    for (const bool plates : {false, true}) {
        SceneBuilder scene;
        scene.add(plane(20)).pointLight({0, 4, 0}).cameraAbove(2);
        if (plates) {
            scene.add(plate(0, 2, 3, 0, 2))
                .add(plate(-2, 0, 3, 0, 2))
                .add(plate(-2, 0, 3, -2, 0))
                .add(plate(0, 2, 3, -2, 0));
        } else {
            scene.add(box({4, 0.5, 4}), {at(0, 3, 0)});
        }
        const ExactScene exact(scene.get());
        const Reference labels = rayLabels(exact, odd, exact.primaryHits(odd));
        for (std::size_t i = 0; i < labels.visibility.size(); ++i) {
            ASSERT_EQ(labels.surface[i], Surface::Receiver) << i;
            ASSERT_EQ(labels.visibility[i], 0.0F) << i;
        }
    }
}

TEST(ExactRays, ANotchBetweenTouchingPlatesIsAnEdge) {
    SceneBuilder scene; // one of the four quarters is missing: the corner is no longer surrounded
    scene.add(plane(20)).pointLight({0, 4, 0}).cameraAbove(2);
    scene.add(plate(0, 2, 3, 0, 2)).add(plate(-2, 0, 3, 0, 2)).add(plate(-2, 0, 3, -2, 0));
    const ExactScene exact(scene.get());
    const Reference labels = rayLabels(exact, odd, exact.primaryHits(odd));
    const int middle = odd.x / 2;
    EXPECT_EQ(labels.surface(middle, middle), Surface::OnEdge);
    EXPECT_EQ(labels.surface(middle + 3, middle), Surface::OnEdge);
    EXPECT_EQ(labels.surface(middle, middle - 3), Surface::OnEdge);
    EXPECT_EQ(labels.surface(middle - 3, middle), Surface::Receiver);
    EXPECT_EQ(labels.visibility(middle - 3, middle), 0.0F);
    EXPECT_EQ(labels.visibility(middle + 3, middle - 3), 1.0F);
}

TEST(ExactRays, AReceiverDoesNotShadowItselfAtAnyAngle) {
    // A convex body: what faces the light is lit, to the last pixel.
    constexpr glm::ivec2 size(64, 64);
    for (const double angle : {0.0, 0.3, 1.1}) {
        SceneBuilder scene;
        scene.add(sphere(1, 2000), {glm::rotate(at(0.1, 0.2, 0.3), angle, glm::dvec3(0.6, 0.8, 0))});
        scene.pointLight({2, 3, 1}).camera({1, 1, 4}, {0, 0, 0});
        const ExactScene exact(scene.get());
        const PrimaryHits primary = exact.primaryHits(size);
        const Reference labels = rayLabels(exact, size, primary);
        std::size_t receivers = 0;
        for (std::size_t i = 0; i < labels.visibility.size(); ++i) {
            if (primary.surface[i] != Surface::Receiver) continue;
            ++receivers;
            ASSERT_EQ(labels.visibility[i], 1.0F) << i;
        }
        EXPECT_GT(receivers, 300U);
    }
}

TEST(ExactRays, DistancesAreThoseToTheMidpointsBetweenDifferentLabels) {
    SceneBuilder scene;
    scene.add(plane(20)).add(plate(0.01F, 4, 3, -4, 4)).pointLight({0, 4, 0}).cameraAbove(2);
    const ExactScene exact(scene.get());
    const Reference labels = rayLabels(exact, odd, exact.primaryHits(odd));
    const int lit = odd.x / 2; // the edge runs between this column and the next one
    for (int x = 0; x < odd.x; ++x) {
        const float expected = x <= lit ? static_cast<float>(lit - x) + 0.5F : static_cast<float>(x - lit) - 0.5F;
        EXPECT_EQ(labels.edgeDistance(x, 9), expected > 8 ? std::numeric_limits<float>::infinity() : expected) << x;
    }
}

TEST(ExactRays, AreaLightsAndWrongSizesAreRefused) {
    SceneBuilder scene;
    scene.add(plane(20)).pointLight({0, 4, 0}).cameraAbove(2);
    const ExactScene exact(scene.get());
    const PrimaryHits primary = exact.primaryHits(odd);
    Reference out;
    EXPECT_THROW(exact.labelByRays({16, 16}, primary, out), InternalError);
    scene.get().light = {LightKind::Rectangle, {0, 4, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    EXPECT_THROW(labelByRays(scene.get(), odd, primary, out), InternalError);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
