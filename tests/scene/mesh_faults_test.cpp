#include "scene/mesh_faults.h"
#include "scene/meshes/primitives.h"

#include <gtest/gtest.h>
#include <utility>

namespace shadowbench {
namespace {

TEST(MeshFaults, ABoxHasNone) {
    const MeshFaults faults = faultsOf(box({1, 2, 3}));
    EXPECT_TRUE(faults.edges.closed());
    EXPECT_EQ(faults.flat.count + faults.repeated.count + faults.doubled.count, 0U);
    EXPECT_NEAR(faults.volume, 6, 1e-6);
}

TEST(MeshFaults, APlaneIsOpenAllAround) {
    const MeshFaults faults = faultsOf(plane(1));
    EXPECT_EQ(faults.edges.open.count, 4U);
    EXPECT_FALSE(faults.edges.closed());
}

TEST(MeshFaults, ATurnedTriangleHasThreeTurnedEdges) {
    Mesh mesh = box({1, 1, 1});
    std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
    EXPECT_EQ(faultsOf(mesh).edges.turned.count, 3U);
    EXPECT_EQ(faultsOf(mesh).edges.open.count, 0U);
}

TEST(MeshFaults, ATriangleTwiceCrowdsItsEdges) {
    Mesh mesh = box({1, 1, 1});
    mesh.triangles.push_back({mesh.triangles[0].z, mesh.triangles[0].y, mesh.triangles[0].x});
    EXPECT_EQ(faultsOf(mesh).repeated.count, 1U);
    EXPECT_EQ(faultsOf(mesh).edges.crowded.count, 3U);
}

TEST(MeshFaults, TurnedInsideOutTheVolumeIsNegative) {
    Mesh mesh = box({1, 1, 1});
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    EXPECT_TRUE(faultsOf(mesh).edges.closed());
    EXPECT_NEAR(faultsOf(mesh).volume, -1, 1e-6);
    EXPECT_NEAR(windingNumber(mesh, {0.1, 0.2, 0.3}), -1, 1e-9);
    EXPECT_NEAR(windingNumber(mesh, {0.1, 0.2, 3}), 0, 1e-9);
}

TEST(MeshFaults, FlatTrianglesAndEqualPositionsHaveAPlace) {
    const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 4}}, false};
    const MeshFaults faults = faultsOf(mesh);
    EXPECT_EQ(faults.flat.count, 1U);
    EXPECT_EQ(faults.flat.place, glm::vec3(1, 0, 0));
    EXPECT_EQ(faults.doubled.count, 1U);
    EXPECT_EQ(faults.doubled.place, glm::vec3(2, 0, 0));
}

} // namespace
} // namespace shadowbench
