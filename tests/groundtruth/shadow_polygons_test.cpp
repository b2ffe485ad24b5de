#include "groundtruth/cgal/plan/shadow_polygons.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "groundtruth/cgal/plan/polygon_files.h"
#include "scene/meshes/primitives.h"
#include "tests/support/exact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <sstream>

namespace shadowbench::groundtruth::testing {

using namespace hard;
using namespace plan;
namespace {

constexpr glm::ivec2 size(48, 48);

/// A ground of 16 m × 16 m, seen from above.
SceneBuilder ground() {
    SceneBuilder scene;
    scene.add(plane(8)).pointLight({0, 4, 0}).camera({0, 30, 0}, {0, 0, 0}, {0, 0, -1});
    return scene;
}

std::vector<PlanarReceiver> receiversOf(const Snapshot& snapshot) {
    const ExactScene exact(snapshot);
    return exact.planarReceivers(exact.primaryHits(size), 1);
}

ShadowPolygons groundShadow(const Snapshot& snapshot) {
    return shadowPolygons(snapshot, {receiversOf(snapshot).front()}).front();
}

double signedArea(const std::vector<glm::dvec2>& ring) {
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

/// Rings turn the right way, visit no point twice and have no straight corners; their areas add up.
void expectSound(const ReceiverRegion& region) {
    double area = 0;
    const auto expectRing = [&](const std::vector<glm::dvec2>& ring) {
        ASSERT_GE(ring.size(), 3U);
        std::set<std::pair<double, double>> points;
        for (const glm::dvec2& p : ring) points.emplace(p.x, p.y);
        EXPECT_EQ(points.size(), ring.size());
        EXPECT_EQ(*points.begin(), std::pair(ring[0].x, ring[0].y));
        area += signedArea(ring);
    };
    for (const PlanarPolygon& polygon : region.polygons) {
        expectRing(polygon.outer);
        EXPECT_GT(signedArea(polygon.outer), 0);
        for (const std::vector<glm::dvec2>& hole : polygon.holes) {
            expectRing(hole);
            EXPECT_LT(signedArea(hole), 0);
        }
    }
    EXPECT_NEAR(area, region.area, 1e-11); // rounding of some hundred products of up to 100 m²
}

TEST(ShadowPolygons, APlateCastsItselfScaled) {
    SceneBuilder scene = ground();
    scene.add(plate(-0.5F, 0.75F, 2, -0.25F, 0.5F)); // half-way up: twice its size
    const ShadowPolygons shadows = groundShadow(scene.get());
    EXPECT_EQ(wkt(shadows.shadow.polygons), "MULTIPOLYGON (((-1 -0.5, 1.5 -0.5, 1.5 1, -1 1, -1 -0.5)))");
    EXPECT_EQ(wkt(shadows.receiver.polygons), "MULTIPOLYGON (((-8 -8, 8 -8, 8 8, -8 8, -8 -8)))");
    EXPECT_EQ(shadows.shadow.area, 3.75);
    EXPECT_EQ(shadows.receiver.area, 256);
    EXPECT_EQ(shadows.shadow.vertices(), 4U);
    EXPECT_EQ(shadows.lightFoot, glm::dvec2(0, 0));
    EXPECT_EQ(shadows.shadow.axes.dropped, 1);
}

TEST(ShadowPolygons, OverlappingShadowsAreOnePolygon) {
    SceneBuilder scene = ground();
    scene.add(plate(-1, 0, 2, -1, 0)).add(plate(-0.75F, 0.75F, 1, -0.75F, 0.75F)); // 2 × 2 and 2 × 2 that share 1 × 1
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    EXPECT_EQ(shadow.polygons.size(), 1U);
    EXPECT_EQ(shadow.vertices(), 8U);
    EXPECT_NEAR(shadow.area, 7, 1e-15);
}

TEST(ShadowPolygons, AFrameHasAHole) {
    SceneBuilder scene = ground();
    scene.add(plate(-1, 1, 2, -1, -0.5F)).add(plate(-1, 1, 2, 0.5F, 1));
    scene.add(plate(-1, -0.5F, 2, -0.5F, 0.5F)).add(plate(0.5F, 1, 2, -0.75F, 0.75F)); // abuts, overlaps
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    EXPECT_EQ(wkt(shadow.polygons), "MULTIPOLYGON (((-2 -2, 2 -2, 2 2, -2 2, -2 -2), (-1 -1, -1 1, 1 1, 1 -1, -1 -1)))");
    EXPECT_EQ(shadow.area, 12);
}

TEST(ShadowPolygons, AbuttingPlatesHaveNoSeam) {
    SceneBuilder scene = ground();
    scene.add(plate(-1, 0.3F, 2, -1, 1)).add(plate(0.3F, 1, 2, -1, 1)); // at different heights, the same shadow line:
    scene.add(plate(-0.5F, 0.5F, 3, 0.5F, 0.75F));                      // four times as large
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    EXPECT_EQ(wkt(shadow.polygons), "MULTIPOLYGON (((-2 -2, 2 -2, 2 3, -2 3, -2 -2)))");
}

TEST(ShadowPolygons, PlatesThatTouchInCornersShareNoRing) {
    SceneBuilder scene = ground();
    for (int i = 0; i < 36; ++i) {
        const int column = i % 6, row = i / 6;
        const float x = 0.5F * static_cast<float>(column - 3), z = 0.5F * static_cast<float>(row - 3);
        if ((column + row) % 2 != 0) scene.add(plate(x, x + 0.5F, 2, z, z + 0.5F));
    }
    const ReceiverRegion chequered = groundShadow(scene.get()).shadow;
    EXPECT_EQ(chequered.polygons.size(), 18U);
    EXPECT_EQ(chequered.area, 18);
    expectSound(chequered);

    // A frame around it joins the outer squares; its holes touch each other and the eight squares that stay alone.
    scene.add(plate(-2, 2, 2, -2, -1.5F)).add(plate(-2, 2, 2, 1.5F, 2));
    scene.add(plate(-2, -1.5F, 2, -1.5F, 1.5F)).add(plate(1.5F, 2, 2, -1.5F, 1.5F));
    const ReceiverRegion framed = groundShadow(scene.get()).shadow;
    EXPECT_EQ(framed.area, 18 + 64 - 36);
    EXPECT_EQ(framed.polygons.size(), 9U);
    expectSound(framed);
}

TEST(ShadowPolygons, ShadowsThatRunToInfinityEndAtTheReceiver) {
    SceneBuilder scene = ground();
    scene.add(box({1, 6, 1}), {at(2, 3, 0)}); // from the ground past the light
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    // Edges along z = ± x / 3 from the near face at x = 1.5 to the ground's end.
    EXPECT_NEAR(shadow.area, (64 - 1.5 * 1.5) / 3, 1e-13);
    EXPECT_EQ(shadow.vertices(), 4U);
    expectSound(shadow);
}

TEST(ShadowPolygons, NoCasterNoShadow) {
    SceneBuilder scene = ground();
    scene.add(plate(-1, 1, 5, -1, 1)).add(plate(-1, 1, -1, -1, 1)); // above the light, below the ground
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    EXPECT_EQ(wkt(shadow.polygons), "MULTIPOLYGON EMPTY");
    EXPECT_EQ(shadow.area, 0);
}

TEST(ShadowPolygons, TiltedPlanesKeepTheirAreaAndTheirPlaceInTheWorld) {
    // A plate close above a tilted ground and parallel to it, under parallel light: its shadow is congruent.
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0.6, 0, 0.8), glm::dvec3(0, 0, 1)}) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.6, axis);
        const glm::dvec3 normal(turn[1]);
        SceneBuilder scene;
        scene.add(plane(4), {turn}).add(plate(-0.5F, 0.75F, 0.5F, -1, 1), {turn});
        scene.directionalLight({0, -1, 0}).camera(20.0 * normal, {0, 0, 0}, {0, 0, -1});
        const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
        ASSERT_EQ(shadow.vertices(), 4U);
        EXPECT_NEAR(shadow.area * shadow.axes.stretch(), 2.5, 1e-14); // vertices are rounded to 1e-16 by their placement
        for (const glm::dvec2& p : shadow.polygons[0].outer) EXPECT_NEAR(glm::dot(normal, shadow.axes.world(p)), 0, 1e-15);
    }
}

TEST(ShadowPolygons, VerticalReceiversKeepTheirHeightUpwards) {
    SceneBuilder scene;
    scene.add(box({8, 8, 1}), {at(0, 4, -0.5)}).add(plate(-1, 1, 5, 1, 2)); // a shelf before a wall in z = 0
    scene.pointLight({0, 8, 4}).camera({0, 4, 20}, {0, 4, 0});
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    EXPECT_EQ(shadow.axes.dropped, 2);
    // From height 8 and 4 m before the wall: its far edge (z = 1) falls to 4, its near edge (z = 2) to 2.
    EXPECT_NEAR(shadow.area, 0.5 * (2 * 4.0 / 3 + 4) * 2, 1e-14);
    EXPECT_EQ(shadow.polygons[0].outer[0], glm::dvec2(-2, 2));
}

struct Comparison {
    std::size_t compared = 0, shadowed = 0, differing = 0, onEdge = 0;
};

/// Labels of every planar receiver, however small, against rays and against the scanline's.
Comparison compare(const Snapshot& snapshot) {
    const ExactScene exact(snapshot);
    const PrimaryHits primary = exact.primaryHits(size);
    const Reference rays = rayLabels(exact, size, primary);
    const std::vector<PlanarReceiver> receivers = exact.planarReceivers(primary, 8);
    const std::vector<ShadowPolygons> shadows = shadowPolygons(snapshot, receivers);
    constexpr float untouched = -1;
    Reference arrangement = rays, scanline = rays;
    std::ranges::fill(arrangement.visibility, untouched);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        labelByRegion(snapshot, size, primary, receivers[i], shadows[i].shadow, arrangement);
        exact.labelByPolygon(size, primary, receivers[i], scanline);
        expectSound(shadows[i].shadow);
    }
    Comparison result;
    for (std::size_t i = 0; i < rays.visibility.size(); ++i) {
        if (arrangement.visibility[i] == untouched) continue;
        if (rays.surface[i] == Surface::OnEdge || arrangement.surface[i] == Surface::OnEdge ||
            scanline.surface[i] == Surface::OnEdge) {
            ++result.onEdge;
            continue;
        }
        ++result.compared;
        result.shadowed += rays.visibility[i] == 0;
        result.differing += arrangement.visibility[i] != rays.visibility[i];
        result.differing += arrangement.visibility[i] != scanline.visibility[i];
    }
    return result;
}

class RandomShadows : public ::testing::TestWithParam<unsigned> {
protected:
    std::mt19937 random_{GetParam()};
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

    /// A tilted ground and a light that may be point or directional, high or so low that occluders straddle its plane.
    SceneBuilder tiltedGround() {
        SceneBuilder scene;
        scene.add(plane(8), {glm::rotate(at(0, uniform(-0.1, 0.1), 0), uniform(-0.3, 0.3), glm::dvec3(1, 0, 0))});
        scene.camera({uniform(-4, 4), uniform(3, 6), uniform(4, 8)}, {0, 0.5, 0});
        if (GetParam() % 3 == 0)
            scene.directionalLight(glm::normalize(glm::dvec3(uniform(-1, 1), -1, uniform(-1, 1))));
        else
            scene.pointLight({uniform(-2, 2), GetParam() % 3 == 1 ? uniform(4, 7) : uniform(2, 2.5), uniform(-2, 2)});
        return scene;
    }

    void expectNoDifference(SceneBuilder& scene) {
        const Comparison c = compare(scene.get());
        EXPECT_EQ(c.differing, 0U);
        EXPECT_EQ(c.onEdge, 0U); // random numbers do not meet
        EXPECT_GT(c.compared, 300U);
        EXPECT_GT(c.shadowed, 0U);
    }
};

TEST_P(RandomShadows, OfTriangleSoupsAreWhatRaysSee) {
    SceneBuilder scene = tiltedGround();
    scene.add(soup(40, {-3, -1, -3}, {3, 3, 3}, random_)); // partly below the ground
    expectNoDifference(scene);
}

TEST_P(RandomShadows, OfTurnedBoxesAreWhatRaysSeeOnBoxesToo) {
    SceneBuilder scene = tiltedGround();
    std::vector<glm::dmat4> places;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const glm::dmat4 place =
            glm::rotate(at(uniform(-3, 3), uniform(0, 2.5), uniform(-3, 3)), uniform(0, 6), glm::normalize(axis));
        places.push_back(
            glm::scale(place, glm::dvec3(uniform(0.3, 1.5), uniform(0.3, 1.5), uniform(-1.5, -0.3)))); // mirrored, too
    }
    scene.add(box({1, 1, 1}), places);
    expectNoDifference(scene);
}

TEST_P(RandomShadows, OfBumpyMeshesAreWhatRaysSee) {
    SceneBuilder scene = tiltedGround();
    scene.add(bumpy(1, 0.4, 2000, GetParam()), {at(uniform(-1, 1), uniform(0, 1.5), uniform(-1, 1)), at(2, 0.5, -1)});
    expectNoDifference(scene);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomShadows, ::testing::Range(1U, 13U));

TEST(ShadowPolygons, LatticesInTheLightsPlanesAreWhatRaysSee) {
    for (int variant = 0; variant < 6; ++variant) {
        SceneBuilder scene;
        scene.add(plane(16)).camera({0.37, 1.7, 0.23}, {0.11, 0, 0.07}, {0, 0, -1});
        const double height = variant % 2 == 0 ? 4 : 3; // 3: in the plane of the plates and of the boxes' upper corners
        scene.pointLight({variant / 2 % 2, height, 0});
        if (variant >= 4)
            scene.directionalLight(variant % 2 == 0 ? glm::dvec3(0, -1, 0) : glm::normalize(glm::dvec3(0, -1, 1)));
        std::vector<glm::dmat4> places;
        for (int x = -2; x <= 2; ++x)
            for (int z = -2; z <= 2; ++z)
                if ((x + z) % 2 == 0) places.push_back(at(x, 2.5, z));
        scene.add(box({1, 1, 1}), places).add(plate(-1, 0, 3, -1, 1)).add(plate(0, 1, 3, -1, 0));
        const Comparison c = compare(scene.get());
        EXPECT_EQ(c.differing, 0U) << variant;
        EXPECT_GT(c.compared, 1000U) << variant;
        EXPECT_GT(c.shadowed, 100U) << variant;
    }
}

TEST(ShadowPolygons, AreTheSameEveryTime) {
    SceneBuilder scene = ground();
    scene.add(bumpy(1, 0.4, 2000, 3), {at(0.1, 1.6, 0.2)}).add(box({1, 1, 1}), {at(1.1, 0.6, 1.2)});
    EXPECT_EQ(wkt(groundShadow(scene.get()).shadow.polygons), wkt(groundShadow(scene.get()).shadow.polygons));
}

TEST(ShadowPolygons, DifferingAreaIsZeroForEqualRegionsOnly) {
    SceneBuilder one = ground(), other = ground();
    one.add(plate(-1, 1, 2, -1, 1));
    other.add(plate(-1, 0.25F, 2, -1, 1)).add(plate(0, 1, 2, -1, 1)); // the same shadow otherwise made
    const ReceiverRegion shadow = groundShadow(one.get()).shadow;
    EXPECT_EQ(differingArea(shadow, groundShadow(other.get()).shadow), 0);
    other.add(plate(1, std::nextafter(1.0F, 2.0F), 2, -1, 1)); // 2^-23 wider: 2^-22 on the ground
    EXPECT_EQ(differingArea(shadow, groundShadow(other.get()).shadow), 4 * 0x1p-22);
}

TEST(ShadowPolygons, AnAreaLightHasNone) {
    SceneBuilder scene = ground();
    const std::vector<PlanarReceiver> receivers = receiversOf(scene.get());
    scene.get().light.kind = LightKind::Rectangle;
    EXPECT_THROW((void)shadowPolygons(scene.get(), receivers), InternalError);
}

TEST(ShadowPolygons, LabelsNeedTheirImages) {
    SceneBuilder scene = ground();
    const PrimaryHits primary = primaryHits(scene.get(), size);
    const PlanarReceiver receiver = receiversOf(scene.get()).front();
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    Reference none, all = rayLabels(ExactScene(scene.get()), size, primary);
    EXPECT_THROW(labelByRegion(scene.get(), size, primary, receiver, shadow, none), InternalError);
    EXPECT_THROW(labelByRegion(scene.get(), {24, 24}, primary, receiver, shadow, all), InternalError);
}

/// Area from text: each ring's shoelace sum, outer rings positive.
double wktArea(const std::string& text) {
    double area = 0;
    std::size_t end = 0;
    for (std::size_t i = 0; i < text.size(); i = end + 1) {
        end = std::min(text.find(')', i), text.size());
        std::string ring = text.substr(i, end - i);
        std::ranges::replace_if(
            ring, [](char c) { return c == '(' || c == ','; }, ' ');
        std::istringstream numbers(ring.starts_with("MULTIPOLYGON") ? ring.substr(12) : ring);
        std::vector<glm::dvec2> points;
        for (glm::dvec2 p; numbers >> p.x >> p.y;) points.push_back(p);
        if (points.empty()) continue;
        EXPECT_EQ(points.front(), points.back());
        points.pop_back();
        area += signedArea(points);
    }
    return area;
}

TEST(PolygonFiles, TextHasTheSameArea) {
    SceneBuilder scene = ground();
    scene.add(bumpy(1, 0.4, 2000, 3), {at(0.1, 1.6, 0.2)}).add(plate(-2, 2, 1, -2, -1)).add(plate(-2, 2, 1.5F, 1, 1.25F));
    const ReceiverRegion shadow = groundShadow(scene.get()).shadow;
    const std::string text = wkt(shadow.polygons);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    EXPECT_NEAR(wktArea(text), shadow.area, 1e-12); // 17 digits give back the doubles; their sum rounds
    EXPECT_GT(shadow.vertices(), 50U);
}

TEST(PolygonFiles, PicturesHoldReceiverShadowAndLight) {
    SceneBuilder scene = ground();
    scene.add(plate(-0.5F, 0.5F, 2, -0.5F, 0.5F));
    const ShadowPolygons shadows = groundShadow(scene.get());
    const std::string picture = svg({"Shadow", "navy", shadows.receiver, shadows.shadow, shadows.lightFoot});
    EXPECT_NE(picture.find("viewBox=\"-8.32 -8.32 16.64 16.64\""), std::string::npos) << picture;
    EXPECT_NE(picture.find("d=\"M-8 -8L8 -8L8 8L-8 8Z\""), std::string::npos);
    EXPECT_NE(picture.find("fill=\"navy\" d=\"M-1 -1L1 -1L1 1L-1 1Z\""), std::string::npos);
    EXPECT_NE(picture.find("cx=\"0\" cy=\"0\""), std::string::npos);
    EXPECT_NE(picture.find("x to the right, z down; y = 0 +0 x +0 z<"), std::string::npos);
    const std::string without = svg({"Shadow", "navy", shadows.receiver, shadows.shadow, glm::dvec2(9, 0)});
    EXPECT_EQ(without.find("circle"), std::string::npos);
}

TEST(PolygonFiles, AreNamedBySurfaceAndPlane) {
    SceneBuilder scene;
    scene.add(plane(8)).add(box({2, 2, 2}), {at(0, 1, 0)}).pointLight({3, 6, 5}).camera({4, 5, 7}, {0, 0.5, 0});
    scene.get().light = {LightKind::Rectangle, {3, 6, 5}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}}; // its centre casts them
    constexpr glm::ivec2 large(128, 128);
    const PrimaryHits primary = primaryHits(scene.get(), large);
    const TemporaryFolder folder;
    const std::vector<std::filesystem::path> files = writeShadowPolygons(scene.get(), primary, folder.path());
    ASSERT_EQ(files.size(), 8U); // the ground and three faces
    EXPECT_EQ(files[0], folder.path() / "shadow-1.wkt");
    EXPECT_EQ(files[1], folder.path() / "shadow-1.svg");
    EXPECT_EQ(files[2], folder.path() / "shadow-2.wkt");
    EXPECT_EQ(files[4], folder.path() / "shadow-2-2.wkt");
    EXPECT_EQ(files[7], folder.path() / "shadow-2-3.svg");
    // The box's shadow falls away from the light at two thirds of its height; what it stands on is in shadow, too.
    EXPECT_GT(wktArea(readFile(files[0])), 4);
    EXPECT_EQ(readFile(files[2]), "MULTIPOLYGON EMPTY\n");
}

TEST(PolygonFiles, NeedAPlane) {
    SceneBuilder scene;
    scene.add(sphere(1, 500)).pointLight({3, 6, 5}).camera({3, 3, 5}, {0, 0.5, 0});
    const TemporaryFolder folder;
    EXPECT_THROW((void)writeShadowPolygons(scene.get(), primaryHits(scene.get(), size), folder.path()), BadInput);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
