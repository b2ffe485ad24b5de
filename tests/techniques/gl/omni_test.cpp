// Maps for lights inside the scene.
#include "tests/support/ground_score.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr float slabTop = -0.001F;

/// Draw calls of a frame.
std::uint64_t drawsOf(Stage& stage, const std::string& name) { return tallied(stage, name, &gl::Tally::draws); }

TEST(SmCube, HoldsAllAroundALightInsideTheSceneWhereOneMapCannot) {
    const Scene scene = ringScene();
    // Half a texel of 418 over 90° is under 2 px where the slab is seen; edges are what is left.
    EXPECT_LT(mismatchOn(1, scene, "sm-cube", slabTop), 0.015);
    EXPECT_LT(mismatchOn(1, scene, "sm-cube:map=4096", slabTop), 0.3 * mismatchOn(1, scene, "sm-cube", slabTop));
    EXPECT_GT(mismatchOn(1, scene, "sm-uniform", slabTop), 0.05);
}

TEST(SmCube, IsRightAwayFromEdges) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-cube:map=2048"), 3).mismatch, 0);
}

TEST(SmCube, DrawsACasterIntoEachSideThatItsBoxMeets) {
    // A lamp over the slab, seen from above: its sides +x, −x, −y, +z and −z hold the slab; nothing is above it.
    Scene scene = groundScene();
    scene.light.centre = {0.1, 0.7, 0.2};
    {
        Stage stage(scene);
        stage.show(0);
        EXPECT_EQ(drawsOf(stage, "sm-cube") - 1, 5U); // one draw is the resolve
    }
    scene.objects.push_back(object(box({0.4, 0.8, 0.3}), {3, 0.43, 0.2})); // in side +x alone
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(drawsOf(stage, "sm-cube") - 1, 5U + 1);
}

TEST(SmCube, DrawsNothingIntoASideThroughWhichTheCameraSeesNothing) {
    Scene scene = ringScene();
    scene.camera = {{-0.6, 0.3, 0.2}, {-5, 0, 0.2}, {0, 1, 0}, 40, 0.1, 40}; // looks along −x, from before the light
    Stage stage(scene);
    stage.show(0);
    const Scene all = ringScene();
    Stage whole(all);
    whole.show(0);
    EXPECT_LT(drawsOf(stage, "sm-cube"), drawsOf(whole, "sm-cube"));
    EXPECT_LT(mismatchOn(1, scene, "sm-cube:map=4096", slabTop), 0.01);
}

/// Every triangle cut into four, `times` over.
Mesh subdivided(Mesh mesh, int times) {
    for (int i = 0; i < times; ++i) {
        Mesh finer;
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            const auto first = static_cast<std::uint32_t>(finer.positions.size());
            for (const glm::vec3& p : {a, b, c, 0.5F * (a + b), 0.5F * (b + c), 0.5F * (c + a)})
                finer.positions.push_back(p);
            for (const glm::uvec3& corners : {glm::uvec3(0, 3, 5), {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
                finer.triangles.push_back(first + corners);
        }
        mesh = weld(finer);
    }
    return mesh;
}

/// The ring scene with all meshes subdivided.
Scene fineRingScene() {
    Scene scene = ringScene();
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        auto& mesh = scene.objects[i].levels[0].mesh;
        mesh = std::make_shared<const Mesh>(subdivided(*mesh, i == 0 ? 6 : 3)); // the slab is large
    }
    return scene;
}

TEST(SmDualParaboloid, HoldsAllAroundALightInsideAFinelyTessellatedScene) {
    EXPECT_LT(mismatchOn(1, fineRingScene(), "sm-dual-paraboloid", slabTop), 0.02);
    EXPECT_LT(mismatchOn(1, fineRingScene(), "sm-dual-paraboloid:map=4096", slabTop), 0.006);
}

TEST(SmDualParaboloid, CoarseTessellationBendsShadowsAndNotThoseOfACubeMap) {
    const double fine = mismatchOn(1, fineRingScene(), "sm-dual-paraboloid:map=4096", slabTop);
    EXPECT_GT(mismatchOn(1, ringScene(), "sm-dual-paraboloid:map=4096", slabTop), 5 * fine);
    EXPECT_LT(mismatchOn(1, ringScene(), "sm-cube:map=4096", slabTop), 1.5 * fine);
}

TEST(SmDualParaboloid, DrawsACasterIntoEachHalfSpaceThatItsBoxMeets) {
    const auto drawn = [](const Scene& scene) {
        Stage stage(scene);
        stage.show(0);
        return drawsOf(stage, "sm-dual-paraboloid") - 1; // one draw is the resolve
    };
    EXPECT_EQ(drawn(groundScene()), 1U); // a lamp far above the slab has all of it before it
    Scene scene = groundScene();
    scene.light.centre = {0, 0.2, 0};
    scene.objects.push_back(object(box({40, 2, 0.2}), {0, 1, -15})); // so that the middle of the scene lies beside the lamp
    EXPECT_EQ(drawn(scene), 2U + 1);                                 // the slab is on both sides of it, the wall on one
}

} // namespace
} // namespace shadowbench
