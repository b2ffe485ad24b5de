// The texel-to-pixel ratio of every technique with a map.
#include "harness/metrics/frames.h"
#include "harness/metrics/table.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "tests/support/stages.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Pixels that show a surface; which way it faces is no matter here.
metrics::Mask everythingDrawn(const metrics::Drawn& drawn) {
    metrics::Mask mask{Image<std::uint8_t>(drawn.id.width(), drawn.id.height(), 0), 0, 0};
    for (std::size_t i = 0; i < drawn.id.size(); ++i) {
        if (drawn.id[i] == 0) continue;
        mask.scored[i] = 1;
        ++mask.count;
    }
    return mask;
}

std::optional<metrics::Aliasing> aliasingOf(Stage& stage, const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto technique = variant.entry->make(variant.parameters);
    stage.render(*technique, 0, 1);
    const metrics::Drawn drawn = stage.drawn();
    const metrics::Mask mask = everythingDrawn(drawn);
    const metrics::MapPoint mapPoint = [&](const glm::dvec3& world) { return technique->mapPoint(world); };
    const auto& normals = stage.normals();
    return metrics::aliasing({stage.shown().camera, drawn.position, normals, mask, mapPoint});
}

bool hasShadowMap(const techniques::Entry& entry) {
    if (entry.answer == techniques::Answer::Soft || entry.id.starts_with("planar")) return false;
    if (entry.id == "sm-tiled" || entry.id == "sm-adaptive" || entry.id == "sm-clipmap")
        return false; // by what pixels ask, below
    return std::ranges::any_of(entry.parameters, [](const techniques::Parameter& p) { return p.name == "map"; });
}

/// Maps of the techniques that have one, at half their size and at all of it.
class EveryMap : public testing::TestWithParam<std::string> {};

// Exact but for the free rim of prefiltered maps, 6 texels whatever the size: (1 − 12/1024) / (1 − 12/512) = 1.012; for the
// tiles of cube and paraboloid maps, rounded to whole texels (1/200); and for the texel of room of a turned map.
TEST_P(EveryMap, HalvingItsSizeDoublesTheRatio) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const std::optional<metrics::Aliasing> whole = aliasingOf(stage, GetParam() + ":map=1024");
    const std::optional<metrics::Aliasing> half = aliasingOf(stage, GetParam() + ":map=512");
    ASSERT_TRUE(whole && half);
    EXPECT_NEAR(half->median / whole->median, 2, 0.03);
    EXPECT_NEAR(half->p95 / whole->p95, 2, 0.03);
    EXPECT_GT(whole->median, 0.02);
    EXPECT_LT(whole->p95, 50);
    EXPECT_GT(whole->mapped, 0.9); // the scene's own map holds all of it, a focused one all that is seen
}

std::vector<std::string> everyMap() {
    std::vector<std::string> ids;
    for (const techniques::Entry& entry : techniques::catalog())
        if (hasShadowMap(entry)) ids.push_back(entry.id);
    return ids;
}

std::string testName(const testing::TestParamInfo<std::string>& tested) {
    std::string name = tested.param;
    std::erase(name, '-');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryMap, testing::ValuesIn(everyMap()), testName);

// One tile that is not weighed by what the map shows is a focused map.
TEST(TiledMap, HalvingItsSizeDoublesTheRatioOfOneTile) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const std::optional<metrics::Aliasing> whole = aliasingOf(stage, "sm-tiled:tiles=1,discontinuity=0,map=1024");
    const std::optional<metrics::Aliasing> half = aliasingOf(stage, "sm-tiled:tiles=1,discontinuity=0,map=512");
    ASSERT_TRUE(whole && half);
    EXPECT_NEAR(half->median / whole->median, 2, 1e-6);
    const std::optional<metrics::Aliasing> tiles = aliasingOf(stage, "sm-tiled");
    ASSERT_TRUE(tiles);
    EXPECT_LT(tiles->median, whole->median);
}

// No texel is longer than a pixel along x or y of the map, so that none is longer than √2 pixels in any direction.
TEST(AdaptiveMap, HasNoTexelLongerThanAPixel) {
    for (const bool sun : {false, true}) {
        Scene scene = boxScene();
        if (sun) scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(-0.3, -1, 0.4)), {}, {}};
        Stage stage(scene);
        stage.show(0);
        const std::optional<metrics::Aliasing> one = aliasingOf(stage, "sm-adaptive"),
                                               four = aliasingOf(stage, "sm-adaptive:density=4");
        ASSERT_TRUE(one && four);
        EXPECT_LE(one->p95, std::sqrt(2) * 1.001); // normals of 16 bits
        EXPECT_LE(four->p95, std::sqrt(2) / 4 * 1.001);
        EXPECT_GT(one->median, 0.25); // nor are they much shorter: levels are powers of two
    }
}

TEST(SmClipmap, HasTexelsOfHalfAPixelToAPixelWhereSunAndCameraLookTheSameWay) {
    Scene scene = groundScene();
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera.up = {0, 0, -1};
    for (const double height : {2.1, 3.3, 5.7, 8.9}) {
        scene.camera.eye = scene.camera.target + glm::dvec3(0, height, 0);
        Stage stage(scene);
        stage.show(0);
        const std::optional<metrics::Aliasing> one = aliasingOf(stage, "sm-clipmap"),
                                               four = aliasingOf(stage, "sm-clipmap:density=4");
        ASSERT_TRUE(one && four);
        EXPECT_EQ(one->mapped, 1);
        EXPECT_LE(one->p95, 1.001); // positions of 32 bits
        EXPECT_GE(one->median, 0.499);
        EXPECT_NEAR(four->median, one->median / 4, 0.001);
    }
}

TEST(TechniquesWithoutAMap, HaveNoRatio) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    for (const char* variant : {"none", "planar-hard", "volume-zfail", "sm-alias-free"})
        EXPECT_FALSE(aliasingOf(stage, variant)) << variant;
}

// Pixels right below the light of a map that looks straight down are as large as in the closed form.
TEST(UniformMap, SeesTheGroundAsItsFrustumSays) {
    Scene scene = groundScene();
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};  // orthographic over the slab of 12 × 12 m
    scene.camera = {{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 45, 0.5, 40}; // straight down: 128 pixels over 2 · 10 tan 22.5° m
    Stage stage(scene);
    stage.show(0);
    const double metresPerPixel = 2 * 10 * std::tan(glm::radians(22.5)) / 128, metresPerTexel = 12.0 / 512;
    const std::optional<metrics::Aliasing> found = aliasingOf(stage, "sm-uniform:map=512");
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->median, metresPerTexel / metresPerPixel, 1e-4);
    EXPECT_NEAR(found->p95, metresPerTexel / metresPerPixel, 1e-4);
    EXPECT_EQ(found->mapped, 1);
}

} // namespace
} // namespace shadowbench
