#include "scene/meshes/primitives.h"
#include "tests/support/exact_comparison.h"
#include "tests/support/exact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowbench::groundtruth::testing {

using namespace hard;
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr glm::ivec2 size(64, 64);

class Lattices : public ::testing::TestWithParam<int> {};

TEST_P(Lattices, PolygonAndRaysAgreeWhereEdgesPassThroughCentresAndLightsLieInVertexPlanes) {
    constexpr glm::ivec2 odd(65, 65);
    const int variant = GetParam();
    SceneBuilder scene;
    scene.add(plane(16)).cameraAbove(2);
    const double height = variant % 2 == 0 ? 4 : 3; // 3: in the plane of the plates and of the upper corners of the boxes
    scene.pointLight({variant / 2 % 2, height, 0});
    if (variant >= 4) scene.directionalLight(variant % 2 == 0 ? glm::dvec3(0, -1, 0) : glm::normalize(glm::dvec3(0, -1, 1)));
    std::vector<glm::dmat4> places;
    for (int x = -2; x <= 2; ++x)
        for (int z = -2; z <= 2; ++z)
            if ((x + z) % 2 == 0) places.push_back(at(x, 2.5, z));
    scene.add(box({1, 1, 1}), places).add(plate(-1, 0, 3, -1, 1)).add(plate(0, 1, 3, -1, 0));
    const Comparison c = compareOracles(scene.get(), odd);
    expectAgreement(c);
    EXPECT_GT(c.compared, 2000U);
    EXPECT_GT(c.shadowed, 100U);
}

INSTANTIATE_TEST_SUITE_P(Variants, Lattices, ::testing::Range(0, 6));

TEST(ExactPolygon, BoxesOnTheirOwnGroundAgreeWithRaysAtEveryLightHeight) {
    for (const double height : {0.25, 0.5, 0.75, 1.0, 1.5, 8.0}) { // the box is 1 high
        SceneBuilder scene;
        scene.add(plane(16)).add(box({1, 1, 1}), {at(0, 0.5, 0), at(1.5, 0.25, 0.5)});
        scene.pointLight({-1.25, height, 0.75}).camera({1, 3, 6}, {0, 0.5, 0});
        const Comparison c = compareOracles(scene.get(), size);
        expectAgreement(c);
        EXPECT_GT(c.shadowed, 30U) << height;
    }
}

TEST(ExactPolygon, CentresWhereAMeshRestsOnThePlaneAreNotCoveredByIt) {
    // A gutter and a funnel whose bottoms touch the ground: their edges cancel, there is shadow all around, and yet the
    // open segment from a point of the bottom to the light is free.
    constexpr glm::ivec2 odd(33, 33);
    const Mesh gutter{{{0, 0, -2}, {0, 0, 2}, {1, 1, 2}, {1, 1, -2}, {-1, 1, 2}, {-1, 1, -2}},
                      {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {0, 5, 4}},
                      false};
    const Mesh funnel{
        {{0, 0, 0}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}, false};
    for (const Mesh& mesh : {gutter, funnel}) {
        SceneBuilder scene; // the camera looks from below the rims
        scene.add(plane(16)).add(mesh).pointLight({0, 4, 0}).cameraAbove(0.5);
        const Comparison c = compareOracles(scene.get(), odd);
        expectAgreement(c);
    }
}

TEST(ExactPolygon, APlaneThroughTheCameraIsNoObstacle) {
    // The ground runs on behind the camera and shadows start there.
    SceneBuilder scene;
    scene.add(plane(16)).add(plate(-3, 3, 2, -1, 9)).pointLight({0.3, 3, -2}).camera({0, 0.5, 4}, {0.2, 0.4, 0});
    const Comparison c = compareOracles(scene.get(), size);
    expectAgreement(c);
    EXPECT_GT(c.shadowed, 100U);
}

TEST(ExactPolygon, PlanarReceiversAreFacesNotSurfaces) {
    SceneBuilder scene;
    scene.add(plane(20)).add(box({2, 1, 1}), {at(0, 0.5, 0)}).add(sphere(0.5, 500), {at(2, 0.5, 1)});
    scene.pointLight({3, 6, 5}).camera({3, 3, 5}, {0, 0.5, 0});
    const ExactScene exact(scene.get());
    const PrimaryHits primary = exact.primaryHits(size);
    const std::vector<PlanarReceiver> planes = exact.planarReceivers(primary, 30);
    ASSERT_EQ(planes.size(), 4U); // the ground and three faces of the box; no facet of the sphere is that large
    EXPECT_EQ(planes[0].id, 1U);
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(planes[i].id, 2U);
        EXPECT_EQ(planes[i].triangles.size(), 2U); // both halves of the face
    }
    std::size_t onGround = 0;
    for (std::size_t i = 0; i < primary.id.size(); ++i)
        onGround += primary.id[i] == 1 && primary.surface[i] == Surface::Receiver;
    EXPECT_EQ(planes[0].pixels, onGround);
}

TEST(ExactPolygon, OtherPixelsAreLeftAlone) {
    SceneBuilder scene;
    scene.add(plane(20)).add(box({2, 1, 1}), {at(0, 0.5, 0)}).pointLight({3, 6, 5}).camera({3, 3, 5}, {0, 0.5, 0});
    const ExactScene exact(scene.get());
    const PrimaryHits primary = exact.primaryHits(size);
    Reference out = rayLabels(exact, size, primary);
    std::ranges::fill(out.visibility, 7.0F);
    exact.labelByPolygon(size, primary, exact.planarReceivers(primary).front(), out);
    for (std::size_t i = 0; i < primary.id.size(); ++i)
        EXPECT_EQ(out.visibility[i] == 7.0F, primary.id[i] != 1 || primary.surface[i] != Surface::Receiver);
}

/// Labels and distances of the ground.
Reference groundLabels(const Snapshot& snapshot, glm::ivec2 image) {
    const ExactScene exact(snapshot);
    const PrimaryHits primary = exact.primaryHits(image);
    Reference out;
    exact.labelByPolygon(image, primary, exact.planarReceivers(primary, 1).front(), out);
    return out;
}

double toSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const double share = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + share * (b - a));
}

using Segments = std::vector<std::pair<glm::dvec2, glm::dvec2>>;

/// Every pixel's distance against that to segments given on the ground (x, z).
void expectDistances(const Snapshot& snapshot, glm::ivec2 image, const Segments& edges) {
    const Reference labels = groundLabels(snapshot, image);
    const auto pixel = [&](const glm::dvec2& xz) { return glm::dvec2(snapshot.camera.project({xz.x, 0, xz.y}, image)); };
    for (int y = 0; y < image.y; ++y)
        for (int x = 0; x < image.x; ++x) {
            double expected = infinity;
            for (const auto& [a, b] : edges)
                expected = std::min(expected, toSegment({x + 0.5, y + 0.5}, pixel(a), pixel(b)));
            if (expected > 8) {
                ASSERT_EQ(labels.edgeDistance(x, y), infinity) << x << ", " << y;
                continue;
            }
            ASSERT_NEAR(labels.edgeDistance(x, y), expected, 1e-6) << x << ", " << y; // promised; floats of 8 are 5e-7 apart
        }
}

TEST(ExactPolygon, DistanceToAHalfPlanesEdgeIsExact) {
    // Light 4 up, plate 2 up: the shadow is the plate scaled by two. Seen at an angle, its border is a slanting line.
    SceneBuilder scene;
    scene.add(plane(30)).add(plate(0.15F, 40, 2, -40, 40)).pointLight({0, 4, 0}).camera({-3, 1.5, 4}, {0, 0, 0});
    scene.get().camera.far = 200;
    constexpr glm::ivec2 image(80, 60);
    const double x = 2 * static_cast<double>(0.15F);
    const Snapshot& snapshot = scene.get();
    const Reference labels = groundLabels(snapshot, image);
    const glm::dvec2 near(snapshot.camera.project({x, 0, 2}, image)), far(snapshot.camera.project({x, 0, -25}, image));
    const glm::dvec2 normal = glm::normalize(glm::dvec2(near.y - far.y, far.x - near.x));
    std::size_t within = 0;
    for (int row = 0; row < image.y; ++row)
        for (int column = 0; column < image.x; ++column) {
            const glm::dvec2 centre(column + 0.5, row + 0.5);
            const double signedDistance = glm::dot(normal, centre - near);
            const glm::dvec2 foot = centre - signedDistance * normal;
            const bool seen =
                foot.x > 1 && foot.x < image.x - 1 && foot.y > 40 && foot.y < image.y - 1; // above, the ground ends
            if (!seen || std::abs(signedDistance) > 8) continue;
            ++within;
            ASSERT_NEAR(labels.edgeDistance(column, row), std::abs(signedDistance), 1e-6) << column << ", " << row;
        }
    EXPECT_GT(within, 50U);
}

TEST(ExactPolygon, EdgesInsideAnotherShadowAreNoShadowEdges) {
    // Two crossing plates, shadows [−1, 1]×[−0.3, 0.3] and [−0.4, 0.4]×[−0.9, 0.9] (light 4 up, plates 2 and 3 up).
    SceneBuilder scene;
    scene.add(plane(30)).pointLight({0, 4, 0}).cameraAbove(1.75);
    scene.add(plate(-0.5F, 0.5F, 2, -0.15F, 0.15F)).add(plate(-0.1F, 0.1F, 3, -0.225F, 0.225F));
    const double x1 = 2 * 0.5, z1 = 2 * static_cast<double>(0.15F), x2 = 4 * static_cast<double>(0.1F),
                 z2 = 4 * static_cast<double>(0.225F);
    scene.get().camera.fovy = 75;
    Segments cross;
    for (const double s : {-1.0, 1.0}) {
        cross.push_back({{s * x1, -z1}, {s * x1, z1}});
        cross.push_back({{-x2, s * z2}, {x2, s * z2}});
        for (const double t : {-1.0, 1.0}) {
            cross.push_back({{s * x1, t * z1}, {s * x2, t * z1}});
            cross.push_back({{s * x2, t * z1}, {s * x2, t * z2}});
        }
    }
    expectDistances(scene.get(), {101, 97}, cross);
}

TEST(ExactPolygon, TheSeamOfTouchingShadowsIsNoShadowEdge) {
    SceneBuilder scene;
    scene.add(plane(30)).pointLight({0, 4, 0}).cameraAbove(1.75);
    scene.add(plate(-0.25F, 0, 2, -0.25F, 0.25F)).add(plate(0, 0.25F, 2, -0.25F, 0.25F));
    scene.get().camera.fovy = 75;
    expectDistances(
        scene.get(), {101, 97},
        {{{-0.5, -0.5}, {0.5, -0.5}}, {{0.5, -0.5}, {0.5, 0.5}}, {{0.5, 0.5}, {-0.5, 0.5}}, {{-0.5, 0.5}, {-0.5, -0.5}}});
}

TEST(ExactPolygon, DistancesAreTheSameInACoarseAndInAFineImage) {
    // Every ninth centre of the fine image is one of the coarse image, whose cells hold many crossing edges each.
    constexpr int factor = 9;
    constexpr glm::ivec2 coarse(15, 15);
    std::mt19937 random(11);
    SceneBuilder scene;
    scene.add(plane(30)).pointLight({0.1, 6, 0.2}).cameraAbove(1.9);
    std::vector<glm::dmat4> places;
    std::uniform_real_distribution<double> anywhere(-0.5, 0.5);
    for (int i = 0; i < 40; ++i) places.push_back(at(anywhere(random), 2 + anywhere(random) / 8, anywhere(random)));
    scene.add(soup(10, {-0.1, 0.1, -0.1}, {0.1, 0.3, 0.1}, random), places);
    const Reference few = groundLabels(scene.get(), coarse), many = groundLabels(scene.get(), factor * coarse);
    std::size_t compared = 0;
    for (int y = 1; y < coarse.y - 1; ++y) // what either image sees beyond its outermost centres differs
        for (int x = 1; x < coarse.x - 1; ++x) {
            const float fine = many.edgeDistance(factor * x + factor / 2, factor * y + factor / 2);
            ASSERT_EQ(few.visibility(x, y), many.visibility(factor * x + factor / 2, factor * y + factor / 2));
            if (fine == infinity) {
                ASSERT_GT(factor * few.edgeDistance(x, y), 8);
                continue;
            }
            ASSERT_NEAR(factor * few.edgeDistance(x, y), fine, factor * 1e-6) << x << ", " << y;
            ++compared;
        }
    EXPECT_GT(compared, 50U);
}

TEST(ExactPolygon, ResultsDoNotDependOnTheNumberOfThreads) {
    SceneBuilder scene;
    scene.add(plane(20)).add(bumpy(1, 0.3, 2000, 5), {at(0, 1, 0), at(2, 1.5, -1)});
    scene.pointLight({1, 5, 2}).camera({3, 3, 5}, {0, 0.5, 0});
    const auto run = [&](int threads) {
        const ExactScene exact(scene.get(), threads);
        const PrimaryHits primary = exact.primaryHits(size);
        Reference out = rayLabels(exact, size, primary);
        exact.labelByPolygon(size, primary, exact.planarReceivers(primary).front(), out);
        return std::tuple(primary.id, primary.triangle, primary.position, out.visibility, out.surface, out.edgeDistance);
    };
    const auto one = run(1);
    EXPECT_EQ(one, run(2));
    EXPECT_EQ(one, run(5));
}

TEST(ExactPolygon, ToolsNameTheirVersions) {
    EXPECT_EQ(toolVersions().count("cgal"), 1U);
    EXPECT_EQ(toolVersions().count("exact"), 1U);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
