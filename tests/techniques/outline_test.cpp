// Outlines as the light sees them and on a silhouette map's grid, against closed forms.
#include "scene/meshes/primitives.h"
#include "techniques/maps/sm-silhouette/dual_edge.h"
#include "techniques/shared/casters/outline.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <set>

namespace shadowbench::techniques {
namespace {

TEST(Outline, OfABoxSeenFromACornerIsAHexagon) {
    const Mesh cube = box({2, 2, 2});
    const EdgeMesh edges(cube);
    std::set<std::uint32_t> corners;
    const auto hexagon = outline(edges, edges.facing({0.1, 1, 0.2, 0})); // lights the top and two sides
    for (const OutlineEdge& edge : hexagon) corners.insert({edge.from, edge.to});
    EXPECT_EQ(hexagon.size(), 6U);
    EXPECT_EQ(corners.size(), 6U);
}

TEST(Outline, OfAnOpenMeshIsItsBorderFromBothSides) {
    const Mesh square = plane(1);
    const EdgeMesh edges(square);
    EXPECT_EQ(outline(edges, edges.facing({0, 1, 0, 0})).size(), 4U);
    EXPECT_EQ(outline(edges, edges.facing({0, -1, 0, 0})).size(), 4U);
}

/// From a light at (0, 4, 0) that shines down and is parallel to x and z: x is right, and −z is up.
glm::dmat4 fromAbove() {
    const Light light{LightKind::Rectangle, {0, 4, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    return lightFromWorld(light, {0, -1, 0});
}

TEST(SeenOutline, OfThePointsUnderALightHasMetresRightUpAndAway) {
    const glm::dvec4 seen = fromAbove() * glm::dvec4(0.25, 1, -0.5, 1);
    EXPECT_EQ(glm::dvec3(seen), glm::dvec3(0.25, 0.5, 3));
}

/// What the light sees of a mesh on the ground below it.
SeenOutline seen(const Mesh& mesh, const glm::dmat4& place = glm::dmat4(1)) {
    return seenOutline(EdgeMesh(mesh), fromAbove() * place, 1e-3);
}

TEST(SeenOutline, OfABoxRunsAroundItsTopWithItsNormalsOutward) {
    const SeenOutline outline = seen(box({2, 1, 2}));
    EXPECT_EQ(outline.vertices.size(), 4U);
    ASSERT_EQ(outline.segments.size(), 4U);
    for (const OutlineSegment& segment : outline.segments) {
        EXPECT_NEAR(segment.from.seen.z, 3.5, 1e-12);
        const glm::dvec2 middle = 0.5 * (segment.from.image() + segment.to.image());
        EXPECT_NEAR(glm::dot(segment.outward, glm::normalize(middle)), 1, 1e-12);
    }
    const std::vector<OutlineCorner> corners = outline.corners();
    ASSERT_EQ(corners.size(), 4U);
    for (const OutlineCorner& corner : corners) {
        EXPECT_NEAR(corner.turn, 0.5 * std::numbers::pi, 1e-12);
        const double half = 0.5 * corner.turn, c = std::cos(half), s = std::sin(half);
        const glm::dvec2 middle(c * corner.outward.x - s * corner.outward.y, s * corner.outward.x + c * corner.outward.y);
        EXPECT_NEAR(glm::dot(middle, glm::normalize(corner.at.image())), 1, 1e-12); // the diagonal
    }
}

TEST(SeenOutline, OfAnOpenMeshPointsOutwardFromBothSides) {
    const glm::dmat4 over = glm::rotate(glm::dmat4(1), std::numbers::pi, glm::dvec3(1, 0, 0));
    for (const glm::dmat4& place : {glm::dmat4(1), over}) {
        const SeenOutline outline = seen(plane(1), place);
        ASSERT_EQ(outline.segments.size(), 4U);
        EXPECT_EQ(outline.corners().size(), 4U);
        for (const OutlineSegment& segment : outline.segments)
            EXPECT_GT(glm::dot(segment.outward, segment.from.image() + segment.to.image()), 0);
    }
}

TEST(SeenOutline, HasNoCornerWhereItTurnsTheOtherWay) {
    // An L of two squares and a third: six vertices, at one of which the outline turns right.
    const Mesh corner{{{0, 0, 0}, {0, 0, 2}, {1, 0, 2}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}},
                      false};
    const SeenOutline outline = seen(corner);
    EXPECT_EQ(outline.segments.size(), 6U);
    EXPECT_EQ(outline.vertices.size(), 6U);
    EXPECT_EQ(outline.corners().size(), 5U);
}

TEST(SeenOutline, OfAClosedMeshIsMadeOfClosedLoops) {
    std::map<std::uint32_t, int> balance;
    for (const OutlineSegment& segment : seen(bumpy(1, 0.3, 2000, 3)).segments) {
        ++balance[segment.first];
        --balance[segment.last];
    }
    ASSERT_GT(balance.size(), 30U);
    for (const auto& [vertex, sum] : balance) EXPECT_EQ(sum, 0) << "vertex " << vertex;
}

TEST(SeenOutline, LeavesOutWhatLiesBehindTheLight) {
    // A wall of which half stands higher than the light: its sides are cut, and its top is gone with the corners there.
    const Mesh wall{{{1, 2, -1}, {1, 6, -1}, {1, 6, 1}, {1, 2, 1}}, {{0, 1, 2}, {0, 2, 3}}, false};
    const SeenOutline outline = seenOutline(EdgeMesh(wall), fromAbove(), 0.5);
    EXPECT_EQ(outline.segments.size(), 3U);
    EXPECT_EQ(outline.vertices.size(), 2U);
    EXPECT_EQ(outline.corners().size(), 2U);
    double least = 9;
    for (const OutlineSegment& segment : outline.segments) least = std::min({least, segment.from.seen.z, segment.to.seen.z});
    EXPECT_NEAR(least, 0.5, 1e-12);
    const glm::dmat4 above = glm::translate(glm::dmat4(1), glm::dvec3(0, 9, 0));
    EXPECT_TRUE(seen(box({1, 1, 1}), above).segments.empty());
}

/// Looks down −y from the height of 2: x and z in [−4, 4] at y = 0.
LightView downwards() {
    Light light{LightKind::Point, {0, 2, 0}, {0, -1, 0}, {}, {}};
    std::vector<glm::dvec3> points;
    for (const double x : {-4.0, 4.0})
        for (const double z : {-4.0, 4.0}) points.emplace_back(x, 0, z);
    return fitToPoints(light, points, {0, 0, 0});
}

TEST(Outline, DualGridHasDepthSamplesAtCorners) {
    const auto edge = onDualGrid(downwards(), {0, 0, 0}, {0, 1, 0}, 64);
    ASSERT_TRUE(edge);
    EXPECT_NEAR(edge->from.x, 32.5,
                1e-4); // the middle of the map is a corner of four texels, hence the middle of a dual cell
    EXPECT_NEAR(edge->from.y, 32.5, 1e-4);
    EXPECT_NEAR(edge->from.x, edge->to.x, 1e-4); // both ends on one light ray
    EXPECT_LT(edge->to.z, edge->from.z);
}

TEST(Outline, CutsAwayWhatLiesBehindTheLight) {
    const LightView view = downwards();
    EXPECT_FALSE(onDualGrid(view, {-1, 2.5, 0}, {1, 3, 0}, 64));
    const auto cut = onDualGrid(view, {1, 0, 0}, {1, 4, 0}, 64), whole = onDualGrid(view, {1, 0, 0}, {1, 1, 0}, 64);
    ASSERT_TRUE(cut && whole);
    EXPECT_EQ(cut->from, whole->from);
    EXPECT_NEAR(cut->to.y, whole->to.y, 1e-3); // the cut end lies on the same line of the map, further out
    EXPECT_GT(std::abs(cut->to.x - cut->from.x), std::abs(whole->to.x - whole->from.x));
}

} // namespace
} // namespace shadowbench::techniques
