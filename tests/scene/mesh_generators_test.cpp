// Every generator makes closed meshes of about the size that is asked for, at every level of detail.
#include "base/error.h"
#include "scene/meshes/primitives.h"
#include "scene/meshes/procedural.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <string>

namespace shadowbench {
namespace {

/// The connected parts of a mesh: for each triangle the smallest position index that its part contains.
std::vector<std::uint32_t> partOfTriangles(const Mesh& mesh) {
    std::vector<std::uint32_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 1; corner < 3; ++corner) {
            const std::uint32_t a = root(t[0]), b = root(t[corner]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<std::uint32_t> part;
    for (const glm::uvec3& t : mesh.triangles) part.push_back(root(t.x));
    return part;
}

/// Six times the volume of each part.
std::map<std::uint32_t, double> volumes(const Mesh& mesh) {
    const std::vector<std::uint32_t> part = partOfTriangles(mesh);
    std::map<std::uint32_t, double> volume;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        // Relative to the part's own first position: small parts far from the origin would drown in rounding.
        const glm::dvec3 origin(mesh.positions[part[i]]);
        const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - origin, b = glm::dvec3(mesh.positions[t.y]) - origin,
                         c = glm::dvec3(mesh.positions[t.z]) - origin;
        volume[part[i]] += glm::dot(a, glm::cross(b, c));
    }
    return volume;
}

struct Generator {
    std::string name;
    std::function<Mesh(int, std::uint32_t)> make;
    std::vector<int> counts;
    double within; // of the count, as documented
};

void PrintTo(const Generator& generator, std::ostream* out) { *out << generator.name; }

class Generators : public testing::TestWithParam<Generator> {};

TEST_P(Generators, MakeClosedPartsThatAllFaceOutward) {
    for (const int count : GetParam().counts) {
        for (const std::uint32_t seed : {1U, 7U, 4242U}) {
            const Mesh mesh = GetParam().make(count, seed);
            ASSERT_TRUE(mesh.closed);
            ASSERT_NO_THROW(requireWellFormed(mesh, GetParam().name)) << count;
            const auto parts = volumes(mesh);
            for (const auto& [part, volume] : parts) ASSERT_GT(volume, 0) << count << ", part " << part;
            // Euler: each part is a sphere topologically, V − E + F = 2, and a closed mesh has E = 3F/2.
            const auto v = static_cast<std::ptrdiff_t>(mesh.positions.size()),
                       f = static_cast<std::ptrdiff_t>(mesh.triangles.size());
            EXPECT_EQ(v - 3 * f / 2 + f, 2 * static_cast<std::ptrdiff_t>(parts.size())) << count;
        }
    }
}

TEST_P(Generators, ComeCloseToTheTrianglesAskedFor) {
    for (const int count : GetParam().counts) {
        const double made = static_cast<double>(GetParam().make(count, 7).triangles.size());
        EXPECT_NEAR(made, count, GetParam().within * count);
    }
}

TEST_P(Generators, GiveTheSameMeshForTheSameSeed) {
    const int count = GetParam().counts.front();
    const Mesh once = GetParam().make(count, 3), again = GetParam().make(count, 3);
    EXPECT_EQ(once.positions, again.positions);
    EXPECT_EQ(once.triangles, again.triangles);
}

const std::vector<Generator> kGenerators{
    {"Sphere", [](int n, std::uint32_t) { return sphere(1.3, n); }, {80, 500, 2000, 10000, 70000}, 0.1},
    {"Bumpy", [](int n, std::uint32_t s) { return bumpy(0.6, 0.25, n, s); }, {80, 500, 2000, 70000}, 0.1},
    {"WindmillTower", [](int n, std::uint32_t) { return windmillTower(n); }, {30, 40, 100, 300, 1500, 6000}, 0.05},
    {"WindmillRotor", [](int n, std::uint32_t) { return windmillRotor(n); }, {54, 60, 70, 100, 200, 600, 2500, 12000}, 0.03},
    {"Tree", [](int n, std::uint32_t s) { return tree(n, s); }, {100, 150, 255, 256, 300, 600, 2000, 5000, 93000}, 0.02},
};

INSTANTIATE_TEST_SUITE_P(Mesh, Generators, testing::ValuesIn(kGenerators),
                         [](const testing::TestParamInfo<Generator>& generator) { return generator.param.name; });

TEST(MeshGenerators, BoxAndColumnAreClosedAndHaveTheirExactVolume) {
    const Mesh cube = box({1, 2, 3});
    requireWellFormed(cube, "box");
    EXPECT_DOUBLE_EQ(volumes(cube).begin()->second, 6 * 6.0);
    const Mesh round = column(0.5, 2, 6);
    requireWellFormed(round, "column");
    EXPECT_NEAR(volumes(round).begin()->second, 6 * 2 * 1.5 * std::sqrt(3.0) * 0.25, 1e-6); // hexagon; positions are floats
    EXPECT_EQ(round.bounds().low.y, 0);
    EXPECT_FALSE(plane(2).closed);
    EXPECT_NO_THROW(requireWellFormed(plane(2), "plane"));
}

TEST(MeshGenerators, ThePlaneFacesUp) {
    const Mesh mesh = plane(2);
    for (const glm::uvec3& t : mesh.triangles)
        EXPECT_GT(glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).y, 0);
}

TEST(MeshGenerators, SpherePositionsLieOnTheSphere) {
    for (const glm::vec3& p : sphere(2.5, 2000).positions)
        EXPECT_NEAR(glm::length(glm::dvec3(p)), 2.5, 3e-7); // rounding to float: 2.5 · 2⁻²⁴ a coordinate
}

TEST(MeshGenerators, BumpyPositionsStayWithinTheBumpAndUseIt) {
    double least = 1e9, most = 0;
    for (const glm::vec3& p : bumpy(1, 0.3, 20000, 5).positions) {
        least = std::min(least, glm::length(glm::dvec3(p)));
        most = std::max(most, glm::length(glm::dvec3(p)));
    }
    EXPECT_GE(least, 0.7 - 1e-6);
    EXPECT_LE(most, 1.3 + 1e-6);
    EXPECT_GT(most - least, 0.15); // a quarter of the range at the very least, else it is no more than a sphere
}

TEST(MeshGenerators, BumpyIsStarShaped) {
    const Mesh mesh = bumpy(1, 0.6, 20000, 11);
    for (const glm::uvec3& t : mesh.triangles) { // every triangle faces away from the centre
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        ASSERT_GT(glm::dot(a, glm::cross(b, c)), 0);
    }
}

TEST(MeshGenerators, SeedsMakeDifferentTreesAndBumps) {
    EXPECT_NE(tree(300, 1).positions, tree(300, 2).positions);
    EXPECT_NE(bumpy(1, 0.2, 300, 1).positions, bumpy(1, 0.2, 300, 2).positions);
}

TEST(MeshGenerators, ModelsKeepTheirSizeOverLevels) {
    for (const int count : {100, 600, 5000, 20000}) {
        const Bounds crown = tree(count, 11).bounds();
        EXPECT_NEAR(crown.high.y, 2.9, 0.2) << count;                 // about 3 m high
        EXPECT_NEAR(crown.high.x - crown.low.x, 1.95, 0.35) << count; // and 2 m wide
    }
    for (const int count : {40, 300, 6000}) EXPECT_NEAR(windmillTower(count).bounds().high.y, 3.4, 1e-3) << count;
    for (const int count : {60, 700, 12000}) EXPECT_NEAR(windmillRotor(count).bounds().high.y, 1.65, 0.05) << count;
}

TEST(MeshGenerators, LeavesOfCardsAreWhatTheirCutoffLeaves) {
    const auto areaOf = [](double cutoff) {
        const Mesh crown = leafCards(10, 0.5, 32, cutoff, 5);
        EXPECT_FALSE(crown.closed);
        EXPECT_NO_THROW(requireWellFormed(crown, "leaf cards"));
        double area = 0;
        for (const glm::uvec3& t : crown.triangles)
            area += 0.5 * glm::length(glm::cross(glm::dvec3(crown.positions[t.y] - crown.positions[t.x]),
                                                 glm::dvec3(crown.positions[t.z] - crown.positions[t.x])));
        for (const glm::vec3& p : crown.positions) EXPECT_LE(glm::length(p), 1.2F); // a card's corners lie beyond its head
        return area / (10 * 0.25);
    };
    const double usual = areaOf(0.5);
    EXPECT_GT(usual, 0.2);
    EXPECT_LT(usual, 0.5);
    EXPECT_GT(areaOf(0.4), 1.2 * usual); // ellipses grow by the square of 0.6 / 0.5, and overlap
    EXPECT_LT(areaOf(0.6), 0.75 * usual);
    EXPECT_NE(leafCards(10, 0.5, 32, 0.5, 5).positions, leafCards(10, 0.5, 32, 0.5, 6).positions);
}

TEST(MeshGenerators, ModelsReachIntoTheGroundSoThatNoFaceLiesInItsPlane) {
    EXPECT_LT(tree(300, 1).bounds().low.y, -0.02);
    EXPECT_LT(windmillTower(300).bounds().low.y, -0.02);
}

} // namespace
} // namespace shadowbench
