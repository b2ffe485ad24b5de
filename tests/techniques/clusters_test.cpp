// The polygons of blockers are put into clusters of like depth.
#include "techniques/soft/convolution/clusters.h"

#include "scene/meshes/primitives.h"
#include "tests/support/plate_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

/// Polygons that reach from one depth to another, given by 1 / depth.
std::vector<BlockerPolygon> polygons(const std::vector<std::array<double, 2>>& inverse, bool ofOneSurface = false) {
    std::vector<BlockerPolygon> result;
    for (std::uint32_t i = 0; i < inverse.size(); ++i)
        result.push_back({{1 / inverse[i][0], 1 / inverse[i][1]}, ofOneSurface ? 1U : i + 1, ofOneSurface ? i : 0});
    return result;
}

TEST(Clusters, SurfacesThatLeaveAGapBecomeGroupsOfTheirOwn) {
    const auto plates = polygons({{0.1, 0.1}, {0.25, 0.25}, {0.5, 0.49}, {0.24, 0.24}});
    EXPECT_EQ(clustered(plates, 1, 8).size(), 1U);
    const std::vector<Cluster> three = clustered(plates, 0.02, 8);
    ASSERT_EQ(three.size(), 3U);
    for (const Cluster& cluster : three) {
        const bool holdsSecond = std::ranges::count(cluster.members, 1U) == 1;
        EXPECT_EQ(std::ranges::count(cluster.members, 3U) == 1, holdsSecond);
        EXPECT_EQ(cluster.members.size(), holdsSecond ? 2U : 1U);
    }
    EXPECT_NE(three[0].group, three[1].group);
    EXPECT_NE(three[1].group, three[2].group);
    EXPECT_EQ(clustered(plates, 0.001, 8).size(), 4U); // one polygon cannot be split
    EXPECT_EQ(clustered(plates, 0.001, 2).size(), 2U);
    EXPECT_TRUE(clustered({}, 0.1, 8).empty());
}

TEST(Clusters, ASurfaceIsSplitInTheMiddleOfItsDepths) {
    const auto stair = polygons({{0.5, 0.4}, {0.4, 0.3}, {0.3, 0.2}, {0.2, 0.1}}, true);
    const std::vector<Cluster> two = clustered(stair, 0.01, 2), four = clustered(stair, 0.01, 4);
    ASSERT_EQ(two.size(), 2U);
    for (const Cluster& cluster : two) EXPECT_NEAR(cluster.range.spread(), 0.2, 1e-12);
    ASSERT_EQ(four.size(), 4U);
    for (const Cluster& cluster : four) {
        EXPECT_NEAR(cluster.range.spread(), 0.1, 1e-12);
        EXPECT_EQ(cluster.group, four[0].group);
    }
}

TEST(Clusters, APolygonThatIsElongatedInTheLightsDirectionCannotBeBrokenDown) { // what the dissertation admits
    EXPECT_EQ(clustered(polygons({{0.5, 0.1}, {0.5, 0.1}}, true), 0.01, 8).size(), 1U);
    EXPECT_EQ(clustered(polygons({{0.5, 0.1}, {0.5, 0.5}, {0.1, 0.1}}, true), 0.01, 8).size(), 1U); // nor do others help
    // Its surface is set apart from others, which can be broken down.
    auto beside = polygons({{0.5, 0.4}, {0.4, 0.3}, {0.3, 0.2}, {0.2, 0.1}}, true);
    beside.push_back({{1 / 0.5, 1 / 0.1}, 2, 0});
    const std::vector<Cluster> five = clustered(beside, 0.11, 8);
    ASSERT_EQ(five.size(), 5U);
    EXPECT_EQ(std::ranges::count(five, five.back().group, &Cluster::group), 1);
    EXPECT_EQ(five.back().members, std::vector<std::size_t>{4});
}

TEST(Clusters, HaveTheirPlaneWherePenumbraeAreHalfwayBetweenThoseOfBothEnds) {
    const BlockerDepths range{2, 4};
    EXPECT_DOUBLE_EQ(1 / range.middle(), 0.5 * (0.5 + 0.25));
    EXPECT_DOUBLE_EQ(range.spread(), 0.25);
}

TEST(Clusters, OfAClosedMeshThePolygonsThatFaceTheLightBlockIt) {
    Scene scene = halfPlaneScene(); // the plate is object 1; the light's centre is above it, beside its edge
    for (const bool isMirrored : {false, true}) {
        if (isMirrored)
            scene.objects[1].instances[0].place = glm::scale(scene.objects[1].instances[0].place, glm::dvec3(1, 1, -1));
        const Snapshot shown = snapshot(scene, 0);
        const LightView view = fitToScene(shown.light, shown);
        const std::vector<BlockerPolygon> polygons = blockerPolygons(shown, view, {false, true});
        ASSERT_EQ(polygons.size(), 4U); // two triangles of the top and two of the side over x = 0.3
        for (const BlockerPolygon& polygon : polygons) {
            EXPECT_EQ(polygon.surface, 2U);
            EXPECT_NEAR(polygon.depths.near, 6 - 2.002, 1e-6); // of 32-bit positions
        }
    }
}

} // namespace
} // namespace shadowbench::techniques
