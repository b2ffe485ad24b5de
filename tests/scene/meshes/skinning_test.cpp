// Linear blend skinning in closed form, and the figure that walks by it.
#include "scene/meshes/walker.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// A quarter turn about z, which takes x to y: of whole numbers.
const glm::dmat4 quarter{{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

SkinnedMesh point(const glm::vec3& at, const BoneWeights& weights) { return {{{at}, {}}, {weights}}; }

TEST(Skinning, AVertexOfOneBoneGoesWhereTheBoneGoes) {
    const std::vector<glm::dmat4> bones{glm::dmat4(1), quarter};
    EXPECT_EQ(posed(point({3, 1, 2}, {{1, 0}, {1, 0}}), bones).positions[0], glm::vec3(-1, 3, 2));
    EXPECT_EQ(posed(point({3, 1, 2}, {{0, 1}, {1, 0}}), bones).positions[0], glm::vec3(3, 1, 2));
}

TEST(Skinning, AVertexOfTwoBonesIsTheMeanOfWhereTheyTakeIt) {
    const std::vector<glm::dmat4> bones{glm::dmat4(1), quarter};
    EXPECT_EQ(posed(point({3, 1, 2}, {{0, 1}, {0.75, 0.25}}), bones).positions[0], glm::vec3(2, 1.5F, 2));
    // Half a turn of one of two bones takes what follows both to the axis.
    const std::vector<glm::dmat4> twisted{glm::dmat4(1), quarter * quarter};
    EXPECT_EQ(posed(point({3, 1, 2}, {{0, 1}, {0.5, 0.5}}), twisted).positions[0], glm::vec3(0, 0, 2));
}

TEST(Skinning, AMeshThatAllBonesMoveAlikeIsMovedAsItIs) {
    const SkinnedMesh figure = walkerAtRest(700);
    const glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(2, -1, 4)) * quarter;
    const Mesh moved = posed(figure, std::vector<glm::dmat4>(10, place));
    for (std::size_t i = 0; i < moved.positions.size(); ++i) {
        const glm::dvec3 expected(place * glm::dvec4(glm::dvec3(figure.mesh.positions[i]), 1));
        EXPECT_LT(glm::distance(glm::dvec3(moved.positions[i]), expected), 1e-6) << "but for rounding to 32 bits";
    }
}

TEST(Walker, HasWeightsThatSumToOne) {
    const SkinnedMesh figure = walkerAtRest(2000);
    ASSERT_EQ(figure.weights.size(), figure.mesh.positions.size());
    int shared = 0;
    for (const BoneWeights& of : figure.weights) {
        EXPECT_EQ(of.weights[0] + of.weights[1], 1);
        EXPECT_GE(std::min(of.weights[0], of.weights[1]), 0);
        shared += of.weights[0] > 0 && of.weights[1] > 0 ? 1 : 0;
    }
    EXPECT_GT(shared, 20) << "knees, elbows and the waist bend";
}

TEST(Walker, IsClosedInEachPoseWithTheSameTriangles) {
    for (const int triangles : {0, 700, 5000}) {
        const Mesh first = walker(triangles, 0, 24);
        EXPECT_LE(first.triangles.size(), static_cast<std::size_t>(std::max(triangles, 328)));
        EXPECT_GT(first.triangles.size(), static_cast<std::size_t>(triangles) / 2);
        for (int pose = 0; pose < 24; ++pose) {
            const Mesh mesh = walker(triangles, pose, 24);
            ASSERT_TRUE(mesh.closed);
            ASSERT_NO_THROW(requireWellFormed(mesh, "walker")) << pose;
            EXPECT_EQ(mesh.triangles, first.triangles);
            EXPECT_NEAR(mesh.bounds().low.y, -0.01, 0.02) << pose << ": the lower foot stands on the ground";
            EXPECT_NEAR(mesh.bounds().high.y, 1.71, 0.06) << pose << ": lower in a long stride";
        }
    }
}

TEST(Walker, TheCycleIsClosedAndHalfOfItIsTheMirroredStep) {
    for (int pose = 0; pose < 8; ++pose) {
        const std::vector<glm::dmat4> now = walkerBones(pose / 8.0), again = walkerBones(1 + pose / 8.0);
        for (std::size_t bone = 0; bone < now.size(); ++bone)
            for (int column = 0; column < 4; ++column)
                EXPECT_LT(glm::length(now[bone][column] - again[bone][column]), 1e-12) << pose << " " << bone;
        const Bounds one = walker(700, pose, 8).bounds(), other = walker(700, pose + 4, 8).bounds();
        EXPECT_NEAR(one.low.x, -other.high.x, 1e-5) << pose;
        EXPECT_NEAR(one.high.z, other.high.z, 1e-5) << pose;
    }
}

} // namespace
} // namespace shadowbench
