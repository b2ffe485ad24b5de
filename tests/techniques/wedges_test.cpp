// Edges of layers and the wedges over them: closed forms, and points that see the light beside an edge.
#include "techniques/shared/casters/wedges.h"

#include "scene/meshes/primitives.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace shadowbench::techniques {
namespace {

using Directed = std::pair<std::uint32_t, std::uint32_t>;

std::multiset<Directed> directed(const std::vector<LayerEdge>& edges) {
    std::multiset<Directed> result;
    for (const LayerEdge& edge : edges)
        for (int layer = 0; layer < edge.layers; ++layer) result.emplace(edge.from, edge.to);
    return result;
}

TEST(LayerEdges, OfAClosedMeshAreItsSilhouette) {
    const Mesh ball = bumpy(1, 0.2, 500, 3);
    const EdgeMesh mesh(ball);
    const auto facing = mesh.facing({3, 4, 5, 1});
    const auto expected = silhouette(mesh, facing);
    EXPECT_GT(expected.size(), 10U);
    EXPECT_EQ(directed(layerEdges(mesh, facing)), std::multiset<Directed>(expected.begin(), expected.end()));
}

TEST(LayerEdges, OfASheetAreItsBorderWithTheSheetOnTheLeftOnWhicheverSideTheLightIs) {
    const Mesh sheet = plane(1);
    const EdgeMesh mesh(sheet);
    const auto above = directed(layerEdges(mesh, mesh.facing({0, 3, 0, 1})));
    const auto below = directed(layerEdges(mesh, mesh.facing({0, -3, 0, 1})));
    EXPECT_EQ(above.size(), 4U);
    std::multiset<Directed> turned;
    for (const auto& [from, to] : below) turned.emplace(to, from);
    EXPECT_EQ(above, turned);
    for (const auto& [from, to] : above) {
        const glm::dvec3 a(sheet.positions[from]), b(sheet.positions[to]);
        EXPECT_GT(glm::cross(a, b).y, 0); // counter-clockwise about the middle, seen from above
    }
}

TEST(LayerEdges, WhereAnOpenMeshFoldsAreOfTwoLayers) {
    // A ridge: of a light on the left, its right half shows the back; both hide, and the ridge ends both.
    const Mesh ridge{{{-1, 0, -1}, {-1, 0, 1}, {0, 1, -1}, {0, 1, 1}, {1, 0, -1}, {1, 0, 1}},
                     {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}},
                     false};
    const EdgeMesh mesh(ridge);
    int two = 0;
    for (const LayerEdge& edge : layerEdges(mesh, mesh.facing({-9, 1, 0, 1}))) {
        if (edge.layers == 1) continue;
        ++two;
        EXPECT_EQ(edge.layers, 2);
        EXPECT_EQ((std::set{edge.from, edge.to}), (std::set<std::uint32_t>{2, 3}));
    }
    EXPECT_EQ(two, 1);
}

TEST(LayerEdges, OfAWholeLightAreThoseOfAllItsPoints) {
    const Mesh ball = bumpy(1, 0.2, 300, 3);
    const EdgeMesh mesh(ball);
    const auto facing = [&](double x, double z) { return mesh.facing({x, 4, z, 1}); };
    const auto all = layerEdges(mesh, facing(0, 0), {facing(-1, -1), facing(-1, 1), facing(1, -1), facing(1, 1)});
    std::set<Directed> edges;
    std::multiset<Directed> ofMiddle;
    for (const LayerEdge& edge : all) {
        edges.insert({std::min(edge.from, edge.to), std::max(edge.from, edge.to)});
        if (edge.layers > 0) ofMiddle.emplace(edge.from, edge.to);
    }
    EXPECT_EQ(ofMiddle, directed(layerEdges(mesh, facing(0, 0))));
    for (double x = -1; x <= 1; x += 0.1)
        for (double z = -1; z <= 1; z += 0.1)
            for (const LayerEdge& edge : layerEdges(mesh, facing(x, z)))
                EXPECT_TRUE(edges.contains({std::min(edge.from, edge.to), std::max(edge.from, edge.to)}));
    EXPECT_LT(edges.size(), mesh.edges().size() / 2);
}

TEST(LayerEdges, HaveTheFacingTriangleOfTheirLightOnTheLeft) {
    const Mesh cube = box({1, 1, 1});
    const EdgeMesh mesh(cube);
    const auto facing = mesh.facing({3, 4, 5, 1});
    for (const LayerEdge& edge : layerEdges(mesh, facing)) {
        EXPECT_TRUE(facing[edge.left]);
        EXPECT_FALSE(facing[edge.right]);
        const glm::uvec3& t = cube.triangles[edge.left];
        const std::set<Directed> sides{{t.x, t.y}, {t.y, t.z}, {t.z, t.x}};
        EXPECT_TRUE(sides.contains({edge.from, edge.to}));
    }
}

int layersOf(const Mesh& mesh, const glm::dvec3& point, const glm::dvec3& light) {
    const EdgeMesh edges(mesh);
    return layersBetween(edges, edges.facing(glm::dvec4(light, 1)), point, light);
}

TEST(LayersBetween, CountsOneForAClosedMeshAndEveryTriangleOfAnOpenOne) {
    const glm::dvec3 light(0.1, 5, 0.2);
    Mesh cube = box({1, 1, 1});
    EXPECT_EQ(layersOf(cube, {0.15, -2, 0.13}, light), 1);
    EXPECT_EQ(layersOf(cube, {0.15, 0.1, 0.13}, light), 1); // within
    EXPECT_EQ(layersOf(cube, {0.15, 2, 0.13}, light), 0);   // before
    EXPECT_EQ(layersOf(cube, {3, -2, 0.13}, light), 0);     // beside
    EXPECT_EQ(layersOf(cube, {0.15, 9, 0.13}, light), 0);   // behind the light
    cube.closed = false;
    EXPECT_EQ(layersOf(cube, {0.15, -2, 0.13}, light), 2);
    EXPECT_EQ(layersOf(plane(1), {0.15, -2, 0.13}, light), 1);
    EXPECT_EQ(layersOf(plane(1), light, {0.15, -2, 0.13}), 1);
}

/// At (0.1, 6, 0.2), turned and tilted.
Light turnedLight() {
    return {LightKind::Rectangle, {0.1, 6, 0.2}, {0, -1, 0}, {1.2, 0.1, 0.5}, {-0.4, -0.0461538, 0.9692308}};
}

/// Distance of a point from a face of a wedge, positive outside.
double beyond(const Wedge& wedge, const std::array<std::uint8_t, 3>& face, const glm::dvec3& point) {
    const glm::dvec3 a = wedge.at(face[0]);
    return glm::dot(glm::normalize(glm::cross(wedge.at(face[1]) - a, wedge.at(face[2]) - a)), point - a);
}

TEST(Wedge, IsClosedAndConvex) {
    std::map<Directed, int> sides;
    for (const auto& face : wedgeTriangles)
        for (std::size_t i = 0; i < 3; ++i) ++sides[{face.at(i), face.at((i + 1) % 3)}];
    for (const auto& [side, count] : sides) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(sides.contains({side.second, side.first}));
    }
    for (const int side : {1, -1})
        for (const glm::dvec3& to : {glm::dvec3(1.3, 0.5, 0.4), {-1.3, 0.3, 0.4}, {-1.2, 1.1, -1.3}, {1.4, -0.2, -1.2}}) {
            const WedgeLight light(turnedLight(), side);
            const glm::dvec3 middle = light.centre + 3.0 * light.axis;
            const auto wedge = wedgeOver(light, middle, middle + to, 0.01, 9);
            ASSERT_TRUE(wedge);
            for (const auto& face : wedgeTriangles)
                for (const glm::dvec3& corner : *wedge) EXPECT_LT(beyond(*wedge, face, corner), 1e-9);
        }
}

/// Points at random on lines from the light through an edge, farther from the light than it.
TEST(Wedge, HoldsWhatSeesTheLightAtTheEdge) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1), within(-1, 1);
    for (int edge = 0; edge < 200; ++edge)
        for (const int side : {1, -1}) {
            const WedgeLight light(turnedLight(), side);
            const auto somewhere = [&] {
                return light.centre + 4.0 * glm::dvec3(within(random), within(random), within(random));
            };
            const glm::dvec3 from = somewhere(), to = somewhere();
            const auto wedge = wedgeOver(light, from, to, 0.01, 9);
            EXPECT_EQ(wedge.has_value(), std::max(light.depth(from), light.depth(to)) > 0.01);
            for (int i = 0; wedge && i < 50; ++i) {
                const glm::dvec3 onEdge = glm::mix(from, to, share(random));
                if (light.depth(onEdge) < 0.01) continue;
                const glm::dvec3 onLight = light.centre + within(random) * light.halfU + within(random) * light.halfV;
                const double reach = 9 / light.depth(onEdge) - 1;
                const glm::dvec3 point = onEdge + reach * share(random) * (onEdge - onLight);
                for (const auto& face : wedgeTriangles) EXPECT_LT(beyond(*wedge, face, point), 0);
            }
        }
}

TEST(Wedge, OverAnEdgeBelowAllReceiversIsNone) {
    const WedgeLight light(turnedLight(), 1);
    EXPECT_FALSE(wedgeOver(light, light.centre + 5.0 * light.axis, light.centre + 6.0 * light.axis, 0.01, 4));
    EXPECT_FALSE(wedgeOver(light, light.centre - 5.0 * light.axis, light.centre - 6.0 * light.axis, 0.01, 4));
}

} // namespace
} // namespace shadowbench::techniques
