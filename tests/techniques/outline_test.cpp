// Silhouette edges on a silhouette map's grid, against closed forms.
#include "scene/meshes/primitives.h"
#include "techniques/maps/sm-silhouette/outline.h"

#include <gtest/gtest.h>
#include <set>

namespace shadowbench::techniques {
namespace {

TEST(Outline, OfABoxSeenFromACornerIsAHexagon) {
    const Mesh cube = box({2, 2, 2});
    const EdgeMesh edges(cube);
    std::set<std::uint32_t> corners;
    const auto hexagon = outline(edges, edges.facing({0.1, 1, 0.2, 0})); // lights the top and two sides
    for (const auto& [from, to] : hexagon) corners.insert({from, to});
    EXPECT_EQ(hexagon.size(), 6U);
    EXPECT_EQ(corners.size(), 6U);
}

TEST(Outline, OfAnOpenMeshIsItsBorderFromBothSides) {
    const Mesh square = plane(1);
    const EdgeMesh edges(square);
    EXPECT_EQ(outline(edges, edges.facing({0, 1, 0, 0})).size(), 4U);
    EXPECT_EQ(outline(edges, edges.facing({0, -1, 0, 0})).size(), 4U);
}

/// Looks down −y from the height of 2: x and z in [−4, 4] at y = 0.
LightView downwards() {
    Light light{LightKind::Point, {0, 2, 0}, {0, -1, 0}, {}, {}};
    std::vector<glm::dvec3> points;
    for (const double x : {-4.0, 4.0})
        for (const double z : {-4.0, 4.0}) points.emplace_back(x, 0, z);
    return fitToPoints(light, points);
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
