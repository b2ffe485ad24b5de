// Shadow volumes of many light samples: the truth of the samples themselves, at a cost that is linear in their number.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "tests/support/sample_truth.h"
#include "tests/support/soft_scenes.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(SampledVolumes, EqualTheExactVisibilityOfTheirOwnSamples) {
    for (const Scene& scene : {halfPlaneScene(), overlapScene()}) {
        Stage stage(scene);
        stage.show(0);
        for (const auto& [pattern, n] : {std::pair{"hammersley", 64}, {"halton", 24}, {"grid", 25}}) {
            const Image<float> v = rendered(stage, fmt::format("sampled-volumes:n={},pattern={}", n, pattern));
            EXPECT_LE(meanErrorOfSamples(stage, v, samplesOf(scene, pattern, n)), rasterised) << pattern;
        }
    }
}

TEST(SampledVolumes, OfAnotherSeedAreThoseOfItsSamples) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "sampled-volumes:n=16,pattern=halton", 1, 3);
    EXPECT_LE(meanErrorOfSamples(stage, v, samplesOf(scene, "halton", 16, 3)), rasterised);
    EXPECT_GT(meanErrorOfSamples(stage, v, samplesOf(scene, "halton", 16, 1)), 10 * rasterised);
}

TEST(SampledVolumes, HaveNoTexels) { // maps of the same samples err by theirs
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const std::vector<glm::dvec3> samples = samplesOf(scene, "hammersley", 16);
    EXPECT_LE(meanErrorOfSamples(stage, rendered(stage, "sampled-volumes:n=16,test=zpass"), samples), rasterised);
    EXPECT_GT(meanErrorOfSamples(stage, rendered(stage, "sampled-maps:n=16,map=256"), samples), 5 * rasterised);
}

TEST(SampledVolumes, ThePenumbraUnderAHalfPlaneIsLinear) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    // 64 samples regular across the edge step by 1/64: an error of 1/64/√12 = 0.0045, and nothing is added to it.
    EXPECT_LE(penumbraRmsError(slabPoints(stage, rendered(stage, "sampled-volumes"))), 0.008);
}

TEST(SampledVolumes, OfNSamplesHaveNPlusOneValues) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    std::array<std::size_t, 6> pixels{};
    for (const float x : rendered(stage, "sampled-volumes:n=5")) {
        EXPECT_NEAR(5 * x, std::round(5 * x), 1e-5);
        ++pixels.at(static_cast<std::size_t>(std::lround(5 * x)));
    }
    for (const std::size_t count : pixels) EXPECT_GT(count, 0U);
}

gl::WorkCount workOf(Stage& stage, int n) {
    const techniques::Variant variant = techniques::parseVariant(fmt::format("sampled-volumes:n={}", n));
    const auto technique = variant.entry->make(variant.parameters);
    stage.render(*technique, 0, 1);
    return timing::measurePasses(stage, *technique, 0, 1, 1).frame().work;
}

TEST(SampledVolumes, CostGrowsLinearlyWithTheNumberOfSamples) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const gl::WorkCount some = workOf(stage, 64), twice = workOf(stage, 128);
    // What the samples share (the G-buffer, the division) is a screen or two beside 64 times as many.
    EXPECT_NEAR(static_cast<double>(twice.fragments) / static_cast<double>(some.fragments), 2, 0.04);
    EXPECT_NEAR(static_cast<double>(twice.primitives) / static_cast<double>(some.primitives), 2, 0.04);
    EXPECT_NEAR(static_cast<double>(twice.draws) / static_cast<double>(some.draws), 2, 0.04);
}

TEST(SampledVolumes, FiguresAreSumsOverTheSamples) {
    Scene scene = boxScene(64);
    scene.light = {LightKind::Rectangle, {0.13, 6, 0.21}, {0, -1, 0}, {0.2, 0, 0}, {0, 0, 0.2}};
    Stage stage(scene);
    stage.show(0);
    // Every sample stands above the tops of slab and box alone: four outline edges each of two triangles, a cap of two
    // triangles at the front, and the ten others' at infinity.
    EXPECT_EQ(figuresOf(stage, "sampled-volumes:n=9").at("volume_triangles"), 9 * 2 * (4 * 2 + 12));
    EXPECT_EQ(figuresOf(stage, "sampled-volumes:n=9,test=zpass").at("volume_triangles"), 9 * 2 * (4 * 2));
    const Image<float> before = rendered(stage, "sampled-volumes:n=9");
    figuresOf(stage, "sampled-volumes:n=9");
    EXPECT_EQ(stage.visibility(), before);
}

TEST(SampledVolumes, CountedAsEachCasterAllowsAreTheSameImageOfFewerTriangles) { // course, Everitt–Kilgard 3.4
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const std::string perCaster = "sampled-volumes:n=9,test=per-caster", byDepthFail = "sampled-volumes:n=9,test=zfail";
    EXPECT_EQ(rendered(stage, perCaster), rendered(stage, byDepthFail));
    EXPECT_LT(figuresOf(stage, perCaster).at("volume_triangles"), figuresOf(stage, byDepthFail).at("volume_triangles"));
}

TEST(SampledVolumes, ByExclusiveOrAreWrongWhereVolumesOverlap) { // Zápotocký 2.4.5
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const std::vector<glm::dvec3> samples = samplesOf(scene, "hammersley", 16);
    EXPECT_GT(meanErrorOfSamples(stage, rendered(stage, "sampled-volumes:n=16,test=xor"), samples), 0.01);
}

TEST(SampledVolumes, LeakUnderAnOpenMesh) { // course, Everitt–Kilgard 3.1: closed models
    const Scene scene = openMeshScene(plane(0.8));
    Stage stage(scene);
    stage.show(0);
    const std::vector<glm::dvec3> samples = samplesOf(scene, "hammersley", 16);
    EXPECT_GT(meanErrorOfSamples(stage, rendered(stage, "sampled-volumes:n=16"), samples), 0.05);
    EXPECT_LE(meanErrorOfSamples(stage, rendered(stage, "sampled-volumes:n=16,test=zpass"), samples), rasterised);
}

TEST(SampledVolumes, RefuseCountsAndTestsThatThereAreNot) {
    for (const char* wrong : {"sampled-volumes:n=0", "sampled-volumes:n=5000", "sampled-volumes:test=stencil"})
        EXPECT_THROW(techniques::parseVariant(wrong), BadInput) << wrong;
}

} // namespace
} // namespace shadowbench
