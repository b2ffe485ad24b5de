#include "base/error.h"
#include "scene/mesh.h"
#include "scene/meshes/primitives.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

std::string complaint(const Mesh& mesh) {
    try {
        requireWellFormed(mesh, "the mesh");
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

TEST(MeshSoundness, AcceptsABoxAndAnOpenPlane) {
    EXPECT_EQ(complaint(box({1, 1, 1})), "");
    EXPECT_EQ(complaint(plane(1)), "");
}

TEST(MeshSoundness, NamesAMissingFace) {
    Mesh mesh = box({1, 1, 1});
    mesh.triangles.pop_back();
    EXPECT_EQ(complaint(mesh),
              "the mesh: not closed: 3 of its edges have no neighbour, the first near (-0.5, 0, 0.5): there is a hole, or "
              "vertices that should be one lie apart; fill it or merge them in the modelling program (Blender: Merge by "
              "Distance), or leave out closed = true");
    mesh.closed = false;
    EXPECT_EQ(complaint(mesh), "");
}

TEST(MeshSoundness, NamesAFlippedFace) {
    Mesh mesh = box({1, 1, 1});
    std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
    EXPECT_EQ(
        complaint(mesh),
        "the mesh: not closed: 3 of its edges belong to two triangles in the same direction, the first near (0.5, -0.5, 0): "
        "some faces are turned inside out; turn them in the modelling program (Blender: Mesh > Normals > Recalculate "
        "Outside), or leave out closed = true");
}

TEST(MeshSoundness, NamesAFaceWithin) {
    Mesh mesh = box({1, 1, 1});
    mesh.triangles.push_back(mesh.triangles[0]);
    EXPECT_EQ(
        complaint(mesh).find("the mesh: not closed: 3 of its edges belong to more than two triangles, the first near ("), 0U)
        << complaint(mesh);
}

TEST(MeshSoundness, NamesAMeshTurnedInsideOut) {
    Mesh mesh = box({1, 1, 1});
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    EXPECT_EQ(complaint(mesh), "the mesh: the mesh is wound inside out; write flip = true beside its file");
}

TEST(MeshSoundness, NamesZeroArea) {
    const Mesh mesh{{{0, 0, 0}, {0.1F, 0.2F, 0.3F}, {0.2F, 0.4F, 0.6F}}, {{0, 1, 2}}, false};
    EXPECT_EQ(
        complaint(mesh),
        "the mesh: triangle 0 has zero area, as 1 of 1 have, the first near (0.1, 0.2, 0.3); delete them in the modelling "
        "program (Blender: Mesh > Clean Up > Degenerate Dissolve)");
}

TEST(MeshSoundness, NamesNanIndexAndEmptiness) {
    EXPECT_EQ(complaint({{{0, 0, NAN}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, false}), "the mesh: position 0 is not finite");
    EXPECT_EQ(complaint({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}, false}),
              "the mesh: triangle 0 uses position 2, but there are only 2");
    EXPECT_EQ(complaint({}), "the mesh: the mesh has no triangle");
}

TEST(MeshSoundness, WeldingASplitBoxClosesIt) {
    const Mesh whole = box({1, 2, 3});
    Mesh split{{}, {}, true};
    for (const glm::uvec3& t : whole.triangles) {
        const auto first = static_cast<std::uint32_t>(split.positions.size());
        for (int corner = 0; corner < 3; ++corner) split.positions.push_back(whole.positions[t[corner]]);
        split.triangles.emplace_back(first, first + 1, first + 2);
    }
    EXPECT_NE(complaint(split), "");
    const Mesh joined = weld(split);
    EXPECT_EQ(joined.positions.size(), 8U);
    EXPECT_EQ(complaint(joined), "");
}

TEST(MeshSoundness, WeldingDropsTrianglesThatCollapseAndJoinsSignedZeros) {
    const Mesh mesh{{{0.0F, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 0, 0}}, {{0, 1, 2}, {0, 3, 1}}, false};
    EXPECT_EQ(weld(mesh).positions.size(), 3U);
    EXPECT_EQ(weld(mesh).triangles.size(), 1U);
}

TEST(MeshBounds, OfATurnedBoxHoldItsCorners) {
    EXPECT_TRUE(Bounds{}.empty());
    EXPECT_TRUE(transformed(Bounds{}, glm::dmat4(1)).empty());
    const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1), {1, 0, 0}), std::acos(-1.0) / 4, {0, 1, 0});
    const Bounds box45 = transformed(box({2, 2, 2}).bounds(), turned);
    EXPECT_NEAR(box45.high.x, 1 + std::sqrt(2.0), 1e-12); // the diagonal of a square of side 2, turned by 45°
    EXPECT_NEAR(box45.low.y, -1, 1e-12);
}

} // namespace
} // namespace shadowbench
