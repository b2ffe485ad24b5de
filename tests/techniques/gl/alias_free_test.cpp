// Irregular z-buffers against the closed form and against stencil volumes.
#include "tests/support/ground_score.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

/// In compute shaders and rasterised.
class EveryIrregularZBuffer : public testing::TestWithParam<std::string> {};

TEST_P(EveryIrregularZBuffer, HasABoxsShadowAsTheExactPolygonToATwentiethOfAPixel) {
    for (const glm::dvec3& light : {glm::dvec3(1.7, 6.1, -2.3), glm::dvec3(9.5, 1.9, -8.3)}) { // the second one grazes
        Scene scene = boxScene(256);
        scene.light.centre = light;
        Stage stage(scene);
        stage.show(0);
        EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, GetParam()), 0.05).mismatch, 0);
    }
}

TEST_P(EveryIrregularZBuffer, HoldsUnderADirectionalLight) {
    Scene scene = boxScene(256);
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(-0.3, -1, 0.4)), {}, {}};
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, GetParam());
    scene.light.centre = -1e6 * scene.light.direction; // for the closed form
    EXPECT_EQ(scoreOnGround(scene, stage, v, 0.05).mismatch, 0);
}

TEST_P(EveryIrregularZBuffer, HoldsAllAroundALightInsideTheScene) {
    const Scene scene = ringScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> exact = rendered(stage, "volume-zfail"), free = rendered(stage, GetParam());
    const metrics::Drawn drawn = stage.drawn();
    std::size_t wrong = 0, dark = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        if (drawn.id[i] != 1 || drawn.position[i].y < -0.001F) continue;
        dark += exact[i] < 0.5F ? 1 : 0;
        wrong += exact[i] != free[i] ? 1 : 0;
    }
    EXPECT_GT(dark, 5000U);
    EXPECT_LE(wrong, 3U); // on an edge, to rounding
}

INSTANTIATE_TEST_SUITE_P(Rows, EveryIrregularZBuffer, testing::Values("sm-alias-free", "frustum-traced"), nameOfText);

TEST(SmAliasFree, TheGridChangesNothing) {
    const Scene scene = boxScene(128);
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "sm-alias-free");
    for (const char* variant : {"sm-alias-free:grid=1", "sm-alias-free:grid=7", "sm-alias-free:grid=1000"})
        EXPECT_EQ(rendered(stage, variant), v) << variant;
}

TEST(SmAliasFree, TilesLoseNoShadowOfATriangle) { // without lists, all triangles are tested against tiles first
    std::mt19937 random(7);
    std::uniform_real_distribution<float> coordinate(-2, 2), size(-0.4F, 0.4F);
    Mesh soup;
    for (std::uint32_t t = 0; t < 300; ++t) {
        const glm::vec3 at(coordinate(random), coordinate(random) + 2, coordinate(random));
        for (int corner = 0; corner < 3; ++corner)
            soup.positions.push_back(at + glm::vec3(size(random), size(random), size(random)));
        soup.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
    }
    Scene scene = groundScene(100); // whose last tiles are cut off
    scene.objects.push_back(object(soup, {0, 0.1, 0}));
    const std::vector<Light> lights{
        {LightKind::Point, {1.7, 6.1, -2.3}, {}, {}, {}},
        {LightKind::Point, {0.2, 2.1, 0.3}, {}, {}, {}}, // amid them
        {LightKind::Directional, {}, glm::normalize(glm::dvec3(-0.3, -1, 0.4)), {}, {}},
    };
    for (const Light& light : lights) {
        scene.light = light;
        Stage stage(scene);
        stage.show(0);
        const Image<float> listed = rendered(stage, "sm-alias-free:grid=64");
        EXPECT_GT(std::count(listed.begin(), listed.end(), 0.0F), 500);
        EXPECT_EQ(rendered(stage, "sm-alias-free:grid=1"), listed);
    }
}

TEST(SmAliasFree, NeedsNoClosedMeshes) {
    Scene scene = groundScene(256);
    const Mesh up = plane(0.7);
    Mesh down = up;
    for (glm::uvec3& triangle : down.triangles) std::swap(triangle.y, triangle.z);
    const auto under = [&](const Mesh& mesh) {
        Scene with = scene;
        with.objects.push_back(object(mesh, {0.13, 1.0, 0.21}));
        Stage stage(with);
        stage.show(0);
        return std::pair{rendered(stage, "sm-alias-free"), rendered(stage, "volume-zfail")};
    };
    const auto [lit, volume] = under(up);
    EXPECT_LE(differing(lit, volume), 3U); // on an edge, to rounding
    const auto [averted, volumeAverted] = under(down);
    EXPECT_EQ(averted, lit);
    EXPECT_GT(differing(volumeAverted, volume),
              500U); // the volume of a sheet that faces away has no front: stencil volumes fail
}

TEST(SmAliasFree, LosesCastersCloserThanItsSlack) {
    Scene scene = groundScene(256);
    scene.objects.push_back(object(plane(0.7), {0.13, 0.1, 0.21}));
    scene.light.centre = {5.5, 1.5, -4.3};
    Stage stage(scene);
    stage.show(0);
    const Image<float> exact = rendered(stage, "sm-alias-free"), loose = rendered(stage, "sm-alias-free:slack=0.01");
    const auto dark = [](const Image<float>& v) { return std::count(v.begin(), v.end(), 0.0F); };
    EXPECT_GT(dark(exact), dark(loose) + 500); // a hundredth of 17 m is more than the sheet's 0.1 m
}

TEST(SmAliasFree, CostsMoreTheLongerItsLists) {
    Scene scene = groundScene(128);
    scene.objects.push_back(object(sphere(0.5, 2000), {0.13, 1.2, 0.21}));
    Stage stage(scene);
    stage.show(0);
    const auto seconds = [&](const std::string& name) {
        const techniques::Variant variant = techniques::parseVariant(name);
        const auto technique = variant.entry->make(variant.parameters);
        stage.render(*technique, 0, 1); // compiles
        gl::Context::current().finish();
        const auto start = std::chrono::steady_clock::now();
        stage.render(*technique, 1, 1);
        gl::Context::current().finish();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    // One list of all 16,384 pixels against lists of about one: a factor of a thousand in tests, far above the clock's
    // noise.
    EXPECT_GT(seconds("sm-alias-free:grid=1"), 5 * seconds("sm-alias-free:grid=128"));
}

} // namespace
} // namespace shadowbench
