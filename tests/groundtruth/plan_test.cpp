#include "groundtruth/cgal/plan/plan_view.h"
#include "scene/load/load.h"
#include "scene/scene.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "groundtruth/cgal/plan/polygon_files.h"
#include "scene/meshes/primitives.h"
#include "tests/support/exact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

namespace shadowbench::groundtruth::testing {

using namespace hard;
using namespace plan;
namespace {

const PlanarReceiver wholeGround{1, {0, 1}, 0}; // both triangles of a `plane`

/// A ground of 16 m × 16 m and a light 2 m above it.
SceneBuilder ground(const glm::dvec2& light = {0, 0}) {
    SceneBuilder scene;
    scene.add(plane(8)).pointLight({light.x, 2, light.y}).camera({0, 30, 0}, {0, 0, 0}, {0, 0, -1});
    return scene;
}

PlanView view(SceneBuilder& scene) { return planView(scene.get(), wholeGround); }

ShadowPolygons shadows(SceneBuilder& scene) { return shadowPolygons(scene.get(), {wholeGround}).front(); }

/// Both derivations give the same shadow, and it and what is seen make up the receiver.
void expectAgreement(SceneBuilder& scene) {
    const PlanView plan = view(scene);
    const ReceiverRegion projected = shadows(scene).shadow;
    EXPECT_EQ(differingArea(plan.shadow, projected), 0);
    EXPECT_EQ(wkt(plan.shadow.polygons), wkt(projected.polygons));
    EXPECT_EQ(plan.light, glm::dvec2(scene.get().light.centre.x, scene.get().light.centre.z));
    EXPECT_NEAR(plan.visible.area + plan.shadow.area, 256, 1e-11); // rounding of some hundred products of up to 256 m²
    EXPECT_GT(plan.visible.area, 0);
}

TEST(Plan, AnEmptyGroundIsAllVisible) {
    SceneBuilder scene = ground();
    EXPECT_EQ(wkt(view(scene).visible.polygons), "MULTIPOLYGON (((-8 -8, 8 -8, 8 8, -8 8, -8 -8)))");
    expectAgreement(scene);
}

TEST(Plan, AColumnHidesASector) {
    SceneBuilder scene = ground();
    scene.add(box({1, 4, 1}), {at(2, 1, 0)});
    const PlanView plan = view(scene);
    EXPECT_NEAR(plan.shadow.area, (64 - 1.5 * 1.5) / 3, 1e-13); // between the lines z = ± x / 3 from x = 1.5 to 8
    EXPECT_EQ(plan.footprints.area, 1);
    expectAgreement(scene);
}

TEST(Plan, AYardIsAllThatALightInItSees) {
    SceneBuilder scene = ground({0.5, -0.25});
    scene.add(box({5, 4, 1}), {at(0, 1, -2), at(0, 1, 2)}).add(box({1, 4, 3}), {at(-2, 1, 0), at(2, 1, 0)}); // they abut
    const PlanView plan = view(scene);
    EXPECT_EQ(plan.visible.area, 9);
    EXPECT_EQ(plan.footprints.area, 16);
    EXPECT_EQ(plan.footprints.polygons.size(), 1U);
    expectAgreement(scene);
}

TEST(Plan, ALightBesideTheReceiverSeesIt) {
    SceneBuilder scene = ground({-12, 0});
    scene.add(box({1, 4, 2}), {at(-10, 1, 0)}).add(box({1, 4, 4}), {at(-8, 1, 5)}); // one beside, one across its border
    const PlanView plan = view(scene);
    EXPECT_GT(plan.shadow.area, 64);
    expectAgreement(scene);
}

TEST(Plan, WhatLiesAboveTheLightOrBelowTheGroundDoesNotMatter) {
    SceneBuilder scene = ground();
    scene.add(box({4, 1, 4}), {at(0, 2.5, 0), at(1, -0.5, 0)}); // they touch both heights
    EXPECT_EQ(view(scene).shadow.area, 0);
    expectAgreement(scene);
}

class RandomPlans : public ::testing::TestWithParam<unsigned> {
protected:
    std::mt19937 random_{GetParam()};
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

    /// Somewhere on the ground but not within `clear` metres of the light.
    glm::dvec2 placeOff(const glm::dvec2& light, double clear) {
        glm::dvec2 place;
        do place = {uniform(-8, 8), uniform(-8, 8)};
        while (glm::distance(place, light) < clear);
        return place;
    }

    /// From below the ground to above the light, turned, at times mirrored.
    glm::dmat4 upright(const glm::dvec2& place, double below) {
        const glm::dmat4 turned = glm::rotate(at(place.x, below, place.y), uniform(0, 6.3), glm::dvec3(0, 1, 0));
        return number(0, 3) == 0 ? glm::scale(turned, glm::dvec3(-1, 1, 1)) : turned;
    }

    void addColumns(SceneBuilder& scene, const glm::dvec2& light) {
        for (int i = number(2, 8); i > 0; --i) {
            const double radius = uniform(0.1, 0.8);
            scene.add(column(radius, uniform(2.5, 4), number(3, 24)),
                      {upright(placeOff(light, radius + 0.05), uniform(-0.4, 0))});
        }
    }

    void addWalls(SceneBuilder& scene, const glm::dvec2& light) {
        for (int i = number(2, 8); i > 0; --i) {
            const glm::dvec2 sides(uniform(0.1, 3), uniform(0.1, 0.5));
            scene.add(box({sides.x, uniform(5, 7), sides.y}),
                      {upright(placeOff(light, glm::length(sides)), uniform(-0.4, 0.4))});
        }
    }

    /// Boxes that share parts of faces, edges or space on a grid of quarters.
    void addBlocks(SceneBuilder& scene, const glm::dvec2& light) {
        const glm::dvec2 corner = glm::round(placeOff(light, 3.5));
        for (int i = number(2, 5); i > 0; --i)
            scene.add(box({0.25 * number(1, 5), 5, 0.25 * number(1, 5)}),
                      {at(corner.x + 0.25 * number(-4, 4), 1, corner.y + 0.25 * number(-4, 4))});
    }
};

TEST_P(RandomPlans, VisibilityAndSilhouettesGiveTheSameShadow) {
    const glm::dvec2 light(uniform(-10, 10), uniform(-10, 10));
    SceneBuilder scene = ground(light);
    addColumns(scene, light);
    addWalls(scene, light);
    addBlocks(scene, light);
    expectAgreement(scene);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPlans, ::testing::Range(1U, 101U));

TEST(Plan, LatticesAlignedWithTheLightGiveTheSameShadow) {
    // Chequered boxes that touch in their edges; the light stands on lines through faces, edges and rows of corners.
    for (const glm::dvec2 light : {glm::dvec2(0, 1), {1, 0}, {0, 0.75}, {0.25, 0.75}, {0, 7}, {-7, 7}, {-4.5, 0.5}}) {
        SceneBuilder scene = ground(light);
        std::vector<glm::dmat4> places;
        for (int x = -3; x <= 3; ++x)
            for (int z = -3; z <= 3; ++z)
                if ((x + z) % 2 == 0) places.push_back(at(x, 1, z));
        scene.add(box({1, 4, 1}), places);
        SCOPED_TRACE(std::to_string(light.x) + ", " + std::to_string(light.y));
        expectAgreement(scene);
    }
}

TEST(Plan, EdgesBehindEdgesGiveTheSameShadow) {
    // Seen from the light, borders of boxes hide each other exactly, and one stands on the ground's border.
    for (const double x : {-2.0, 0.0, 0.5, 1.0}) {
        SceneBuilder scene = ground({x, 0});
        scene.add(box({1, 4, 1}), {at(2.5, 1, 1.5), at(4.5, 1, 2.5), at(4.5, 1, 0.5), at(2.5, 1, -1.5), at(7.5, 1, -3.5)});
        scene.add(box({2, 4, 2}), {at(7, 1, 1), at(-4, 1, 1), at(-4, 1, -1), at(7, 1, 7)});
        SCOPED_TRACE(x);
        expectAgreement(scene);
    }
}

/// The reason why a scene is no plan.
std::string refusal(SceneBuilder& scene) {
    try {
        (void)view(scene);
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

void expectRefusal(SceneBuilder& scene, const std::string& reason) {
    const std::string given = refusal(scene);
    EXPECT_NE(given.find(reason), std::string::npos) << given;
}

TEST(Plan, OtherScenesAreRefusedWithTheReason) {
    SceneBuilder low = ground(), hovering = ground(), slanting = ground(), open = ground();
    low.add(box({1, 1.5, 1}), {at(3, 0.5, 0)});
    expectRefusal(low, "surface 2 has a vertex between");
    hovering.add(sphere(0.1, 20), {at(3, 5, 0)}).add(box({1, 4, 1}), {at(3, 2.5, 0)});
    expectRefusal(hovering, "surface 3 has a vertex between");
    slanting.add(box({1, 9, 1}), {glm::rotate(at(3, 1, 0), 0.1, glm::dvec3(1, 0, 0))});
    expectRefusal(slanting, "surface 2 has a slanting face");
    open.add({{{1, -1, 1}, {2, -1, 1}, {2, 3, 1}}, {{0, 1, 2}}, false});
    expectRefusal(open, "surface 2 is not closed");
}

TEST(Plan, OtherLightsAreRefusedWithTheReason) {
    SceneBuilder inside = ground({3.2, 0}), touching = ground({2.5, 0}), sun = ground(), below = ground();
    inside.add(box({1, 5, 1}), {at(3, 1, 0)});
    expectRefusal(inside, "the light stands in a column");
    touching.add(box({1, 5, 1}), {at(3, 1, 0)});
    expectRefusal(touching, "the light stands exactly on a wall");
    sun.directionalLight({0, -1, 0});
    expectRefusal(sun, "needs a point light; this scene has a directional light");
    below.pointLight({0, -1, 0});
    expectRefusal(below, "surface 1 is a receiver that does not lie below the light");
}

TEST(Plan, ATiltedReceiverIsNoPlan) {
    SceneBuilder scene;
    scene.add(plane(8), {glm::rotate(glm::dmat4(1), 0.1, glm::dvec3(1, 0, 0))}).pointLight({0, 4, 0});
    expectRefusal(scene, "surface 1 is a receiver that is not horizontal");
    EXPECT_TRUE(planReceivers(scene.get(), {wholeGround}).empty());
}

TEST(Plan, OfColonnadeAgreesWithPolygonsAndRaysInEveryPixel) {
    constexpr glm::ivec2 size(256, 256);
    const Scene scene = loadScene("colonnade", Profile::Gate);
    const Snapshot frame = snapshot(scene, scene.timeline.still - 1);
    const ExactScene exact(frame);
    const PrimaryHits primary = exact.primaryHits(size);
    const std::vector<PlanarReceiver> grounds = planReceivers(frame, exact.planarReceivers(primary));
    ASSERT_EQ(grounds.size(), 1U);
    const PlanarReceiver& receiver = grounds.front();
    const ShadowPolygons shadows = shadowPolygons(frame, grounds).front();
    EXPECT_EQ(differingArea(planView(frame, receiver).shadow, shadows.shadow), 0);

    const Reference rays = rayLabels(exact, size, primary);
    Reference scanline = rays, arrangement = rays, plan = rays;
    exact.labelByPolygon(size, primary, receiver, scanline);
    labelByRegion(frame, size, primary, receiver, shadows.shadow, arrangement);
    labelByPlan(frame, size, primary, receiver, plan);
    for (const Reference* other : {&scanline, &arrangement, &plan}) {
        EXPECT_EQ(other->visibility, rays.visibility);
        EXPECT_EQ(other->surface, rays.surface); // no centre lies on an edge
    }
    std::size_t lit = 0;
    for (std::size_t i = 0; i < primary.id.size(); ++i) lit += primary.id[i] == receiver.id && plan.visibility[i] == 1;
    EXPECT_GT(lit, receiver.pixels / 4);
    EXPECT_LT(lit, receiver.pixels * 3 / 4);
}

TEST(Plan, LabelsOnAShadowEdgeAreLeftOpen) {
    // Seen straight from above (3, 3): pixel centres with x = z lie exactly on the shadow's edge, the diagonal.
    constexpr glm::ivec2 size(17, 17);
    SceneBuilder scene = ground();
    scene.add(box({1, 4, 2}), {at(1.5, 1, 0)}).camera({3, 2, 3}, {3, 0, 3}, {0, 0, -1});
    const PrimaryHits primary = primaryHits(scene.get(), size);
    Reference labels = rayLabels(ExactScene(scene.get()), size, primary);
    labelByPlan(scene.get(), size, primary, planarReceivers(scene.get(), primary, 1).front(), labels);
    for (int i = 0; i < size.x; ++i)
        for (int j = 0; j < size.y; ++j) {
            EXPECT_EQ(labels.surface(i, j), i == j ? Surface::OnEdge : Surface::Receiver) << i << ", " << j;
            EXPECT_EQ(labels.visibility(i, j), i > j ? 0.0F : 1.0F) << i << ", " << j;
        }
}

TEST(Plan, FilesShowWhatIsVisible) {
    SceneBuilder scene = ground();
    scene.add(box({1, 4, 1}), {at(2, 1, 0)});
    const PrimaryHits primary = primaryHits(scene.get(), {64, 64});
    const TemporaryFolder folder;
    const std::vector<std::filesystem::path> files = writeVisiblePolygons(scene.get(), primary, folder.path());
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[0], folder.path() / "visible-1.wkt");
    EXPECT_EQ(readFile(files[0]), wkt(view(scene).visible.polygons) + "\n");
    EXPECT_NE(readFile(files[1]).find("Seen by the light on surface 1"), std::string::npos);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
