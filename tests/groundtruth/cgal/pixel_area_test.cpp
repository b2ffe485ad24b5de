// The mean over a pixel's square: closed forms, and agreement of polygons and rays.
#include "groundtruth/cgal/hard/pixel_area.h"
#include "groundtruth/cgal/hard/pixel_patches.h"
#include "scene/load/load.h"
#include "scene/meshes/primitives.h"
#include "tests/support/exact_scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace shadowbench::groundtruth::testing {
namespace {

constexpr glm::ivec2 size{32, 32};

Reference means(const Snapshot& snapshot) {
    const ExactScene scene(snapshot);
    const PrimaryHits primary = scene.primaryHits(size);
    Reference out = rayLabels(scene, size, primary);
    scene.averageOverPixels(size, primary, out);
    return out;
}

/// Image position of the ground below x or z, seen straight from above from a height.
double pixelsFromMiddle(double metres, double height) {
    return metres / height / std::tan(0.5 * 45 * 3.14159265358979323846 / 180) * size.x / 2;
}

/// Share of [low, low + 1] that lies in [from, to].
double shareWithin(double low, double from, double to) { return std::max(0.0, std::min(to, low + 1) - std::max(from, low)); }

TEST(PixelArea, OfAnUprightShadowIsTheProductOfTheSharesOfItsSides) {
    SceneBuilder scene;
    scene.add(plate(-9, 9, 0, -9, 9)).add(plate(0.2F, 1.3F, 1, 0.4F, 1.1F)).directionalLight({0, -1, 0});
    scene.camera({0, 8, 0}, {0, 0, 0}, {0, 0, -1});
    const Reference found = means(scene.get());
    // The plate hides most of its shadow: what is left lies towards the middle of the image.
    const auto at = [](double metres, double height) { return 16 + pixelsFromMiddle(metres, height); };
    std::size_t partly = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto within = [&](double height) {
                return shareWithin(x, at(static_cast<double>(0.2F), height), at(static_cast<double>(1.3F), height)) *
                       shareWithin(y, at(static_cast<double>(0.4F), height), at(static_cast<double>(1.1F), height));
            };
            const double plateSeen = within(7), shadow = within(8);
            const double both = shareWithin(x, at(static_cast<double>(0.2F), 7), at(static_cast<double>(1.3F), 8)) *
                                shareWithin(y, at(static_cast<double>(0.4F), 7), at(static_cast<double>(1.1F), 8));
            const bool isGround = found.id(x, y) == 1; // of the plate all is lit
            const double expected = isGround ? 1 - (shadow - both) / (1 - plateSeen) : 1;
            EXPECT_NEAR(found.visibility(x, y), expected, 1e-6) << x << " " << y;
            EXPECT_EQ(found.sigma(x, y), 0) << x << " " << y;
            partly += plateSeen > 0 && plateSeen < 1;
        }
    EXPECT_GT(partly, 8U);
}

TEST(PixelArea, OfAnObliqueEdgeIsTheAreaOnItsLitSide) {
    // The shadow's edge runs through the middle of the image at 45°: pixels on the diagonal are half lit.
    SceneBuilder scene;
    const Mesh halfPlane{{{-20, 3, -20}, {20, 3, 20}, {-20, 3, 20}}, {{0, 1, 2}}, false};
    scene.add(plate(-9, 9, 0, -9, 9)).add(halfPlane).directionalLight({0, -1, 0});
    scene.camera({0, 2, 0}, {0, 0, 0}, {0, 0, -1});
    const Reference found = means(scene.get());
    for (int i = 0; i < size.x; ++i) EXPECT_NEAR(found.visibility(i, i), 0.5, 1e-6) << i;
    EXPECT_EQ(found.visibility(20, 10), 1);
    EXPECT_EQ(found.visibility(10, 20), 0);
}

TEST(PixelArea, CountsSurfacesThatFaceTheLightAndNoOthers) {
    // A ridge's lit side and its side away from the light meet within a column of pixels; nothing casts a shadow.
    SceneBuilder scene;
    const Mesh ridge{{{-4, 0, -4}, {-4, 0, 4}, {0.1F, 4, 4}, {0.1F, 4, -4}, {4, 0, 4}, {4, 0, -4}},
                     {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}},
                     false};
    scene.add(ridge).directionalLight({0.99, -0.1, 0}).cameraAbove(14);
    const Reference found = means(scene.get());
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < found.visibility.size(); ++i) {
        if (found.surface[i] != Surface::Receiver) continue;
        ++receivers;
        EXPECT_EQ(found.visibility[i], 1) << i;
    }
    EXPECT_GT(receivers, 50U);
}

/// Rays, one in each of 24 × 24 cells, err by 0.35 % where an edge crosses; where dozens do, by more.
void expectAgreement(const Snapshot& snapshot, double mostRms) {
    const ExactScene scene(snapshot);
    const PrimaryHits primary = scene.primaryHits(size);
    Reference found = rayLabels(scene, size, primary);
    const Reference labels = found;
    scene.averageOverPixels(size, primary, found);
    double squares = 0, sum = 0;
    std::size_t partly = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (found.surface(x, y) != Surface::Receiver) continue;
            const float v = found.visibility(x, y);
            EXPECT_LE(found.sigma(x, y), 0.01F) << x << " " << y;
            if (v == 0 || v == 1) {
                EXPECT_TRUE(labels.surface(x, y) != Surface::Receiver || v == labels.visibility(x, y)) << x << " " << y;
                continue;
            }
            if ((x + y) % 3 != 0) continue; // rays take their time
            const double error = v - scene.meanByRays(size, {x, y}, found.id(x, y), 24).mean;
            squares += error * error;
            sum += error;
            ++partly;
        }
    ASSERT_GT(partly, 10U);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(partly)), mostRms);
    EXPECT_LT(std::abs(sum) / static_cast<double>(partly), 0.5 * mostRms);
}

TEST(PixelArea, OfPolygonsIsThatOfRaysOnBuiltInScenes) {
    for (const char* id : {"dueling-frusta", "simple", "windmills", "trees", "colonnade", "picket-fence", "contact",
                           "near-plane", "caster-behind-eye", "open-mesh"}) {
        SCOPED_TRACE(id);
        const Scene scene = loadScene(id, Profile::Gate);
        Snapshot shown = snapshot(scene, scene.timeline.still - 1);
        shown.light = shown.light.centreOnly();
        expectAgreement(shown, 0.008);
    }
}

TEST(PixelArea, OfPolygonsIsThatOfRaysWhereTrianglesPassThroughOneAnother) {
    std::mt19937 random(7);
    SceneBuilder scene;
    scene.add(plate(-9, 9, 0, -9, 9)).add(soup(60, {-3, -0.5F, -3}, {3, 2.5F, 3}, random));
    scene.pointLight({1.3, 4.1, 0.7}).camera({4, 5, 6}, {0, 0.5, 0});
    expectAgreement(scene.get(), 0.008);
}

TEST(PixelArea, OfASurfaceBehindAnotherIsNoShareAtAll) {
    const hard::ImageRectangle square = hard::pixelSquare({3, 5});
    hard::Patch ground;
    for (const glm::dvec2& corner : {glm::dvec2(3, 5), glm::dvec2(4, 5), glm::dvec2(4, 6), glm::dvec2(3, 6)})
        ground.outline.add(corner);
    ground.inverseDepth = {0, 0, 0.1};
    ground.counts = true;
    hard::Patch plate = ground;
    plate.inverseDepth = {0, 0, 1};
    plate.counts = false;
    EXPECT_EQ(hard::shares({ground, plate}, square).seen, 0);
    EXPECT_EQ(hard::shares({ground}, square).seen, 1);
}

/// A shadowed ground that three plates hide but for a triangle of 0.01 px around the pixel's centre, which no corner is
/// level with; `shadows` more of the ground lie behind the plates.
std::vector<hard::Patch> slitOverTheCentre(int shadows) {
    const hard::ImageRectangle square = hard::pixelSquare({3, 5});
    const auto patch = [&](const hard::ImagePolygon& outline, double nearness) {
        hard::Patch result;
        result.outline = outline;
        result.inverseDepth = {0, 0, nearness};
        result.counts = true;
        return result;
    };
    const auto polygon = [&](std::initializer_list<glm::dvec2> corners) {
        Corners<glm::dvec3> inImage;
        for (const glm::dvec2& corner : corners) inImage.add(glm::dvec3(square.low + corner, 1));
        return hard::HomogeneousPolygon(inImage).in(square);
    };
    std::vector<hard::Patch> patches{patch(polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), 0.1)};
    for (int i = 0; i < shadows; ++i) {
        const double at = 0.1 + 0.3 * i / shadows;
        patches.front().shadows.push_back(polygon({{at, at}, {at + 0.05, at}, {at, at + 0.05}}));
    }
    patches.front().shadows.push_back(polygon({{-1, 0.1}, {2, 0.2}, {2, 0.9}, {-1, 0.8}}));
    for (const double degrees : {77.0, 197.0, 317.0}) {
        const double angle = degrees * 3.14159265358979323846 / 180;
        const glm::dvec2 out(std::cos(angle), std::sin(angle)), along(-out.y, out.x), edge = 0.5 + 0.003 * out;
        patches.push_back(patch(
            polygon({edge - 3.0 * along, edge + 3.0 * along, edge + 3.0 * (along + out), edge + 3.0 * (out - along)}), 1));
    }
    return patches;
}

TEST(PixelArea, ThatLinesFindWhollyLitDoesNotContradictTheShadowOfItsCentre) {
    for (const int shadows : {40, 400}) { // too many edges for their crossings; too many for their corners, too
        const hard::AreaShares found = hard::shares(slitOverTheCentre(shadows), hard::pixelSquare({3, 5}));
        EXPECT_LT(found.lit / found.seen, 1 - 1e-6) << shadows;
        EXPECT_NEAR(found.lit / found.seen, 1, 3 * found.sigma) << shadows;
        EXPECT_LE(found.sigma, 0.0095) << shadows;
    }
    const hard::AreaShares exact = hard::shares(slitOverTheCentre(1), hard::pixelSquare({3, 5}));
    EXPECT_NEAR(exact.lit, 1 - 3 * std::sqrt(3) * 0.003 * 0.003, 1e-9);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
