// Visible fractions against closed forms and in degenerate positions.
#include "base/error.h"
#include "tests/support/area_scenes.h"

#include <numbers>

namespace shadowbench::groundtruth::testing {

using namespace area;
using namespace hard;
namespace {

constexpr double rounding = 1e-14; // closed forms in double precision, a few operations

/// Share of a shape of width 2 whose coordinate lies below `edge`.
double shareBelow(LightKind kind, double edge) {
    const double e = std::clamp(edge, -1.0, 1.0);
    if (kind != LightKind::Disk) return 0.5 * (e + 1);
    return 0.5 + (e * std::sqrt(1 - e * e) + std::asin(e)) / std::numbers::pi;
}

class AreaKinds : public ::testing::TestWithParam<LightKind> {};

TEST_P(AreaKinds, HalfPlaneHasItsClosedForm) {
    SceneBuilder scene = litGround(GetParam());
    scene.add(plate(0.25F, 20, 2, -20, 20));
    for (const double x : {-1.0, -0.4375, -0.1, 0.0, 0.25, 0.31, 0.7, 1.1, 1.5, 2.0}) {
        const VisibleFraction found = fractionAt(scene.get(), {x, 0, 0.0625});
        const double expected = shareBelow(GetParam(), 0.5 - x); // the edge projects to x + 2 (¼ − x)
        EXPECT_LE(found.low, expected + rounding) << x;
        EXPECT_GE(found.high, expected - rounding) << x;
        EXPECT_LE(found.high - found.low, GetParam() == LightKind::Disk ? 1e-4 : 0) << x;
    }
}

TEST_P(AreaKinds, NothingInTheWayIsExactlyOneAndUmbraExactlyZero) {
    SceneBuilder scene = litGround(GetParam());
    scene.add(plate(2.5F, 3, 2, -20, 20)).add(bumpy(0.7, 0.2, 300, 5), {at(-3, 2, 0)});
    const VisibleFraction lit = fractionAt(scene.get(), {0.1, 0, 0.2});
    EXPECT_EQ(lit.low, 1);
    EXPECT_EQ(lit.high, 1);
    scene.add(bumpy(1.7, 0.2, 300, 5), {at(-1, 1, 0)}).add(plate(-6, 1, 3, -3, 3));
    const VisibleFraction dark = fractionAt(scene.get(), {-0.9, 0, 0.1});
    EXPECT_EQ(dark.low, 0);
    EXPECT_EQ(dark.high, 0);
}

TEST_P(AreaKinds, WhatLiesInTheLightsPlaneOrBehindItHidesNothing) {
    SceneBuilder scene = litGround(GetParam());
    scene.add(plate(-1, 1, 4, -1, 1)).add(plate(-2, 0.5F, 5, -2, 2)).add(box({1, 1, 1}), {at(0, -2, 0)});
    EXPECT_EQ(fractionAt(scene.get(), {0.3, 0, 0.1}).low, 1);
}

TEST_P(AreaKinds, OnlyThePartBeforeTheLightsPlaneHides) {
    // A wall from the ground through the light's plane: x = −δ hides what is left of −δ on the light.
    const double delta = 0x1p-20;
    SceneBuilder scene = litGround(GetParam());
    const auto x = static_cast<float>(-delta);
    scene.add({{{x, 0, -9}, {x, 0, 9}, {x, 20, 9}, {x, 20, -9}}, {{0, 1, 2}, {0, 2, 3}}, false});
    const VisibleFraction found = fractionAt(scene.get(), {0, 0, 0.125});
    const double expected = 1 - shareBelow(GetParam(), -delta);
    EXPECT_LE(found.low, expected + rounding);
    EXPECT_GE(found.high, expected - rounding);
}

TEST_P(AreaKinds, ALightSeenEdgeOnHasNoFraction) {
    SceneBuilder scene; // a wall x = 0, and the light in the plane of the pixel's point
    scene.add({{{0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}}, {{0, 1, 2}, {0, 2, 3}}, false});
    scene.get().light = {GetParam(), {3, 4, 0.5}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    if (GetParam() == LightKind::Line) scene.get().light = {LightKind::Line, {3, 4, 0.5}, {0, -1, 0}, {1, 0, 0}, {0, 0, 0}};
    scene.camera({2, 4, 0.5}, {0, 4, 0.5});
    const glm::ivec2 size(1, 1);
    const PrimaryHits primary = primaryHits(scene.get(), size);
    const AreaScene area(scene.get());
    for (const VisibleFraction f : {area.fraction({0, 0}, size, primary), area.exactFraction({0, 0}, size, primary)}) {
        EXPECT_EQ(f.low, 0);
        EXPECT_EQ(f.high, 1);
    }
    Reference out;
    area.label(size, primary, out);
    EXPECT_EQ(out.surface(0, 0), Surface::OnEdge);
}

INSTANTIATE_TEST_SUITE_P(Lights, AreaKinds, ::testing::Values(LightKind::Rectangle, LightKind::Disk, LightKind::Line),
                         [](const auto& parameter) { return std::string(name(parameter.param)); });

TEST(Area, APlateInsideTheView) {
    SceneBuilder scene = litGround();
    scene.add(plate(-0.25F, 0.25F, 2, -0.25F, 0.25F));
    EXPECT_NEAR(visibleAt(scene.get(), {0.1, 0, 0.05}), 0.75, rounding); // a square of side 1 of one of side 2
}

TEST(Area, OverlapCountsOnce) {
    SceneBuilder scene = litGround();
    scene.add(plate(-0.25F, 0.125F, 2, -0.25F, 0.25F)); // on the light: [−½, ¼] × [−½, ½]
    scene.add(plate(0, 0.125F, 1, -0.0625F, 0.1875F));  // [0, ½] × [−¼, ¾]; they share 3/16
    EXPECT_NEAR(visibleAt(scene.get(), {0, 0, 0}), 1 - (0.75 + 0.5 - 0.1875) / 4, rounding);
}

TEST(Area, DisjointOccludersAdd) {
    SceneBuilder scene = litGround();
    scene.add(plate(-20, -0.25F, 2, -20, 20)).add(plate(0.25F, 20, 2, -20, 20)); // hides below −½ and above ½
    EXPECT_NEAR(visibleAt(scene.get(), {0, 0, 0}), 0.5, rounding);
}

TEST(Area, ASlabHidesWithItsNearerEdge) {
    SceneBuilder scene = litGround();
    scene.add(box({20, 1, 40}), {at(10.25, 1.5, 0)}); // x from ¼, y from 1 to 2
    EXPECT_NEAR(visibleAt(scene.get(), {0, 0, 0.5}), shareBelow(LightKind::Rectangle, 0.5), rounding);    // upper edge
    EXPECT_NEAR(visibleAt(scene.get(), {0.5, 0, 0.5}), shareBelow(LightKind::Rectangle, -0.5), rounding); // lower edge
    EXPECT_EQ(visibleAt(scene.get(), {1.5, 0, 0.5}), 0);
}

TEST(Area, ASkewLightIsMeasuredInItsOwnCoordinates) {
    SceneBuilder scene = litGround();
    scene.get().light.v = {1, 0, 2}; // x = 2a + b
    SceneBuilder other = scene;
    scene.add(plate(0, 20, 2, -20, 20));
    EXPECT_NEAR(visibleAt(scene.get(), {0, 0, 0}), 0.5, rounding);
    other.add(plate(0.5F, 20, 2, -20, 20)); // hides 2a + b > 1 with |a|, |b| ≤ ½: legs ¼ and ½
    EXPECT_NEAR(visibleAt(other.get(), {0, 0, 0}), 1 - 0.0625, rounding);
}

TEST(Area, OpenAndClosedMeshesHideAlike) {
    const Mesh closed = box({0.7, 0.5, 0.6});
    Mesh open = closed; // without the faces on top: a way into the box leads through another face
    std::erase_if(open.triangles, [&](const glm::uvec3& t) {
        return open.positions[t.x].y > 0 && open.positions[t.y].y > 0 && open.positions[t.z].y > 0;
    });
    open.closed = false;
    ASSERT_EQ(open.triangles.size(), closed.triangles.size() - 2);
    const glm::dmat4 place = glm::rotate(at(0.1, 1.7, 0.2), 0.4, glm::dvec3(0, 1, 0));
    SceneBuilder a = litGround(), b = litGround();
    a.add(closed, {place});
    b.add(open, {place});
    for (const double x : {-0.7, 0.0, 0.3, 0.9}) {
        const double visible = visibleAt(a.get(), {x, 0, 0.1});
        EXPECT_LT(visible, 1);
        EXPECT_NEAR(visible, visibleAt(b.get(), {x, 0, 0.1}), rounding);
    }
}

TEST(Area, AbuttingTrianglesLeaveNoCrackWhetherTheyShareVerticesOrNot) {
    // A disc of sectors around an inner point that projects into the light.
    constexpr unsigned sectors = 23;
    Mesh fan;
    fan.positions.emplace_back(0.0312F, 2.0F, 0.0173F);
    for (unsigned i = 0; i < sectors; ++i) {
        const double angle = 2 * std::numbers::pi * i / sectors;
        fan.positions.emplace_back(std::cos(angle), 2 + 0.3 * std::sin(3 * angle), std::sin(angle));
        fan.triangles.emplace_back(0, i + 1, (i + 1) % sectors + 1);
    }
    SceneBuilder whole = litGround(), pieces = litGround();
    whole.add(fan);
    for (const glm::uvec3& t : fan.triangles)
        pieces.add({{fan.positions[t.x], fan.positions[t.y], fan.positions[t.z]}, {{0, 1, 2}}, false});
    EXPECT_EQ(visibleAt(whole.get(), {0.1, 0, 0.05}), 0);
    EXPECT_EQ(visibleAt(pieces.get(), {0.1, 0, 0.05}), 0);
    const double visible = visibleAt(whole.get(), {1.1, 0, 0.05});
    EXPECT_GT(visible, 0.05);
    EXPECT_NEAR(visibleAt(pieces.get(), {1.1, 0, 0.05}), visible, rounding);
}

TEST(Area, EdgesAlongTheLightsSides) {
    SceneBuilder exact = litGround(), outside = litGround(), twice = litGround(), diagonal = litGround();
    exact.add(plate(-0.5F, 0.5F, 2, -0.5F, 0.5F)); // just the light
    EXPECT_EQ(visibleAt(exact.get(), {0, 0, 0}), 0);
    outside.add(plate(0.5F, 1, 2, -0.5F, 0.5F)).add(plate(-0.5F, 0.5F, 2, 0.5F, 1)); // touch two sides
    EXPECT_EQ(visibleAt(outside.get(), {0, 0, 0}), 1);
    twice.add(plate(-0.5F, 0, 2, -0.5F, 0.5F)).add(plate(-0.25F, 0, 1, -0.25F, 0.25F)); // four coincident edges
    EXPECT_NEAR(visibleAt(twice.get(), {0, 0, 0}), 0.5, rounding);
    diagonal.add({{{-0.5F, 2, -0.5F}, {-0.5F, 2, 0.5F}, {0.5F, 2, 0.5F}}, {{0, 1, 2}}, false}); // from corner to corner
    EXPECT_NEAR(visibleAt(diagonal.get(), {0, 0, 0}), 0.5, rounding);
}

TEST(Area, BackFacesHideAsMuch) {
    Mesh front = plate(-0.25F, 0.3F, 2, -0.2F, 0.25F), back = front;
    for (glm::uvec3& t : back.triangles) std::swap(t.y, t.z);
    SceneBuilder a = litGround(), b = litGround();
    EXPECT_EQ(visibleAt(a.add(front).get(), {0.1, 0, 0}), visibleAt(b.add(back).get(), {0.1, 0, 0}));
}

TEST(Area, InconsistentlyWoundNeighboursHideTheirUnion) {
    Mesh mesh = plate(-0.25F, 0.25F, 2, -0.25F, 0.25F);
    std::swap(mesh.triangles[1].y, mesh.triangles[1].z);
    EXPECT_NEAR(visibleAt(litGround().add(mesh).get(), {0, 0, 0}), 0.75, rounding);
}

TEST(Area, InstancesAndMirroredInstances) {
    const Mesh mesh = bumpy(0.3, 0.1, 180, 3);
    const auto shifted = [](Mesh m, float sign, float x) {
        for (glm::vec3& p : m.positions) p = {sign * p.x + x, p.y + 2, p.z};
        if (sign < 0)
            for (glm::uvec3& t : m.triangles) std::swap(t.y, t.z);
        return m;
    };
    SceneBuilder placed = litGround(), baked = litGround();
    placed.add(mesh, {at(0.5, 2, 0), glm::scale(at(-0.25, 2, 0), glm::dvec3(-1, 1, 1))});
    baked.add(shifted(mesh, 1, 0.5F)).add(shifted(mesh, -1, -0.25F));
    for (const double x : {-0.8, 0.0, 0.6}) {
        const double visible = visibleAt(placed.get(), {x, 0, 0});
        EXPECT_LT(visible, 1);
        EXPECT_NEAR(visible, visibleAt(baked.get(), {x, 0, 0}), 1e-6); // the baked vertices are rounded to floats
    }
}

TEST(Area, APointOnAnEdgeOrVertexOfItsOwnMeshSeesPastIt) {
    SceneBuilder scene;
    scene.add(box({1, 1, 1}), {at(0, -0.5, 0)}).add(plate(0.75F, 20, 2, -20, 20));
    scene.get().light = lightAbove();
    for (const double z : {0.0, 0.5}) // an edge, a vertex
        EXPECT_NEAR(visibleAt(scene.get(), {0.5, 0, z}), shareBelow(LightKind::Rectangle, 1.5 - 0.5), rounding);
    SceneBuilder corner; // floor and wall in one mesh: on the shared edge the wall is seen edge-on
    corner.get().light = lightAbove();
    corner.add({{{0, 0, -9}, {0, 0, 9}, {9, 0, 9}, {9, 0, -9}, {0, 3, -9}, {0, 3, 9}},
                {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}},
                false});
    EXPECT_EQ(visibleAt(corner.get(), {0, 0, 0.25}), 1);
    EXPECT_NEAR(visibleAt(corner.get(), {0x1p-30, 0, 0.25}), 0.5, 1e-8); // just before it: half the light, less 2⁻³⁰ · ⅓
}

TEST(Area, ThreadsDoNotMatter) {
    SceneBuilder scene = litGround();
    scene.add(bumpy(0.6, 0.2, 500, 4), {at(0.2, 1.4, 0.1)}).camera({2, 3, 4}, {0, 0.5, 0});
    const glm::ivec2 size(24, 24);
    const PrimaryHits primary = primaryHits(scene.get(), size);
    Reference one, three;
    AreaScene(scene.get(), 1).label(size, primary, one);
    AreaScene(scene.get(), 3).label(size, primary, three);
    EXPECT_EQ(one.visibility, three.visibility);
    EXPECT_EQ(one.sigma, three.sigma);
    EXPECT_EQ(one.surface, primary.surface);
    EXPECT_GT(std::ranges::count_if(one.visibility, [](float v) { return v > 0 && v < 1; }), 20);
    EXPECT_LT(*std::ranges::max_element(one.sigma), fastError);
}

TEST(Area, OtherLightsAndOtherPixelsAreRefused) {
    SceneBuilder scene = litGround();
    scene.cameraAbove(2);
    const glm::ivec2 size(2, 2);
    PrimaryHits primary = primaryHits(scene.get(), size);
    const AreaScene area(scene.get());
    primary.surface(1, 1) = Surface::FacesAway;
    EXPECT_NO_THROW((void)area.fraction({0, 0}, size, primary));
    EXPECT_THROW((void)area.fraction({1, 1}, size, primary), InternalError);
    EXPECT_THROW((void)area.fraction({2, 0}, size, primary), InternalError);
    EXPECT_THROW((void)area.fraction({0, 0}, {3, 2}, primary), InternalError);
    scene.pointLight({0, 4, 0});
    EXPECT_THROW(AreaScene{scene.get()}, InternalError);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
