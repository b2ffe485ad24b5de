// Silhouettes and shadow volumes of meshes whose answer is known.
#include "scene/camera.h"
#include "scene/meshes/primitives.h"
#include "techniques/shared/casters/shadow_volume.h"

#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace shadowbench::techniques {
namespace {

Mesh cube() { return box({2, 2, 2}); }

TEST(Silhouette, OfACubeSeenFromInfinityAboveIsTheSquareAroundItsTop) {
    const Mesh mesh = cube();
    const EdgeMesh edges(mesh);
    const auto outline = silhouette(edges, edges.facing({0, 1, 0, 0}));
    EXPECT_EQ(outline.size(), 4U);
    for (const auto& [a, b] : outline) {
        EXPECT_FLOAT_EQ(mesh.positions[a].y, 1);
        EXPECT_FLOAT_EQ(mesh.positions[b].y, 1);
    }
}

TEST(Silhouette, OfACubeSeenAlongItsDiagonalIsAHexagon) {
    const Mesh mesh = cube();
    const EdgeMesh edges(mesh);
    EXPECT_EQ(silhouette(edges, edges.facing({5, 6, 7, 1})).size(), 6U);
}

TEST(Silhouette, OfAClosedMeshIsMadeOfClosedLoops) {
    const Mesh mesh = bumpy(1, 0.3, 2000, 3);
    const EdgeMesh edges(mesh);
    std::map<std::uint32_t, int> balance;
    for (const auto& [a, b] : silhouette(edges, edges.facing({4, 5, -3, 1}))) {
        ++balance[a];
        --balance[b];
    }
    ASSERT_FALSE(balance.empty());
    for (const auto& [vertex, sum] : balance) EXPECT_EQ(sum, 0) << "vertex " << vertex;
}

TEST(Silhouette, IncludesTheBorderOfAnOpenMeshThatFacesTheLight) {
    const Mesh mesh = plane(1);
    const EdgeMesh edges(mesh);
    EXPECT_EQ(silhouette(edges, edges.facing({0, 3, 0, 1})).size(), 4U);
    EXPECT_TRUE(silhouette(edges, edges.facing({0, -3, 0, 1})).empty());
}

TEST(EdgeMesh, EveryEdgeOfAClosedMeshHasTwoTriangles) {
    const Mesh mesh = sphere(1, 500);
    const EdgeMesh edges(mesh);
    EXPECT_EQ(edges.edges().size() * 2, mesh.triangles.size() * 3);
    for (const EdgeMesh::Edge& edge : edges.edges()) EXPECT_NE(edge.right, EdgeMesh::none);
}

/// Directed edges of a shadow volume that no opposite one cancels.
int openEdges(const std::vector<std::uint32_t>& indices) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (std::size_t t = 0; t < indices.size(); t += 3)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t a = indices[t + corner], b = indices[t + (corner + 1) % 3];
            if (a < b)
                ++balance[{a, b}];
            else
                --balance[{b, a}];
        }
    int open = 0;
    for (const auto& [edge, sum] : balance) open += sum != 0 ? 1 : 0;
    return open;
}

TEST(ShadowVolume, OfAClosedMeshUnderAPointLightIsClosed) {
    for (const Mesh& mesh : {cube(), bumpy(1, 0.3, 2000, 3)}) {
        std::vector<std::uint32_t> indices;
        appendShadowVolume(EdgeMesh(mesh), {4, 5, -3, 1}, Caps::Both, indices);
        EXPECT_EQ(openEdges(indices), 0);
    }
}

TEST(ShadowVolume, OfAnOpenMeshLeaks) {
    const Mesh mesh = plane(1);
    std::vector<std::uint32_t> indices;
    appendShadowVolume(EdgeMesh(mesh), {0, 3, 0, 1}, Caps::Both, indices);
    EXPECT_GT(openEdges(indices), 0); // no averted triangle closes it at infinity
}

TEST(ShadowVolume, UnderADirectionalLightEndsInAPointAtInfinity) {
    const Mesh mesh = cube();
    std::vector<std::uint32_t> indices;
    appendShadowVolume(EdgeMesh(mesh), {0, 1, 0, 0}, Caps::Both, indices);
    EXPECT_EQ(indices.size() / 3, 2U + 4U); // the top's two triangles, one triangle a silhouette edge
}

TEST(ShadowVolume, WithoutCapsHasTwoTrianglesAnEdgeOfTheSilhouette) {
    const Mesh mesh = cube();
    std::vector<std::uint32_t> indices;
    appendShadowVolume(EdgeMesh(mesh), {5, 6, 7, 1}, Caps::None, indices);
    EXPECT_EQ(indices.size() / 3, 2U * 6U);
}

TEST(InfiniteProjection, CostsAHundredthOfTheDepthPrecisionFromOneToAHundred) { // course, Everitt–Kilgard 3.2.1
    Camera camera;
    camera.near = 1;
    camera.far = 100;
    const glm::dmat4 finite = camera.projection(1), infinite = infiniteProjection(finite, camera.near);
    const auto window = [](const glm::dmat4& projection, double distance) {
        const glm::dvec4 clip = projection * glm::dvec4(0, 0, -distance, 1);
        return 0.5 + 0.5 * clip.z / clip.w;
    };
    for (const double distance : {1.5, 7.0, 60.0}) {
        const double ratio = (window(infinite, distance + 0.1) - window(infinite, distance)) /
                             (window(finite, distance + 0.1) - window(finite, distance));
        EXPECT_NEAR(ratio, 0.99, 1e-9); // (far − near) / far, at every distance
    }
    EXPECT_EQ(window(infinite, 1), 0);
    const glm::dvec4 atInfinity = infinite * glm::dvec4(0, 0, -1, 0);
    EXPECT_EQ(atInfinity.z, atInfinity.w); // depth 1: not clipped
}

} // namespace
} // namespace shadowbench::techniques
