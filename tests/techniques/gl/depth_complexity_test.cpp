// Depth complexity sampling: the truth of its own samples, wherever casters overlap and silhouettes change, at a cost that
// grows with the samples.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "techniques/shared/sampling/light_points.h"
#include "tests/support/sample_truth.h"
#include "tests/support/soft_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Mean error of what sees its own samples but for rounding: a pixel of a thousand may have one of them wrong.
constexpr double exact = 1e-4;

double errorOfSamples(const Scene& scene, const std::string& pattern, int count, std::uint32_t seed = 1) {
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, fmt::format("depth-complexity:n={},pattern={}", count, pattern), 1, seed);
    return meanErrorOfSamples(stage, v, techniques::lightPoints(scene.light, pattern, count, seed));
}

/// A cube under a light that is wider than it.
Scene cubeScene() {
    Scene scene = groundScene(96);
    scene.light = {LightKind::Rectangle, {0.1, 6, -0.1}, {0, -1, 0}, {2.6, 0, 0.2}, {-0.2, 0, 2.6}};
    scene.camera = {{1.9, 4.2, 4.4}, {0, 0.3, -0.1}, {0, 1, 0}, 41, 0.5, 40};
    scene.objects.push_back(object(box({0.8, 0.8, 0.8}), {0.1, 2.6, 0}, 17));
    return scene;
}

TEST(DepthComplexity, EqualsTheExactVisibilityOfItsOwnSamplesWhereCastersOverlap) {
    EXPECT_LE(errorOfSamples(overlapScene(), "hammersley", 64), exact);
    EXPECT_LE(errorOfSamples(overlapScene(), "halton", 23), exact); // no multiple of the four counters of a word
    EXPECT_LE(errorOfSamples(halfPlaneScene(), "grid", 25), exact);
}

TEST(DepthComplexity, EqualsThemUnderACubeWhoseSilhouetteChangesOverTheLight) {
    const Scene scene = cubeScene();
    EXPECT_LE(errorOfSamples(scene, "hammersley", 64), exact);
    Stage stage(scene); // penumbra wedges over the middle's silhouettes alone err
    stage.show(0);
    const auto samples = techniques::lightPoints(scene.light, "hammersley", 64, 1);
    EXPECT_GT(meanErrorOfSamples(stage, rendered(stage, "penumbra-wedge"), samples), 0.01);
}

TEST(DepthComplexity, EqualsThemUnderOpenMeshesOnWhicheverSideTheLightIs) {
    Scene scene = groundScene(96);
    scene.light = {LightKind::Rectangle, {0.2, 6.1, 0.3}, {0, -1, 0}, {1.1, 0, 0}, {0, 0, 1.1}};
    Mesh back = plane(0.6);
    for (glm::uvec3& triangle : back.triangles) std::swap(triangle.y, triangle.z);
    Mesh bowl = bumpy(0.8, 0.2, 300, 5);
    bowl.closed = false;
    std::erase_if(bowl.triangles, [&](const glm::uvec3& t) { return bowl.positions[t.x].y > 0.25F; });
    scene.objects.push_back(object(plane(0.7), {0.9, 1.5, 0.7}, 20));
    scene.objects.push_back(object(back, {0.5, 2.4, 0.2}, 35));
    scene.objects.push_back(object(bowl, {-1.3, 1.2, 0.4}));
    EXPECT_LE(errorOfSamples(scene, "hammersley", 64), exact);
}

TEST(DepthComplexity, EqualsThemWithTheEyeInTheShadow) {
    Scene scene = overlapScene();
    scene.camera = {{0.1, 0.7, 0.2}, {-0.6, 0, 0.9}, {0, 1, 0}, 80, 0.01, 40};
    EXPECT_LE(errorOfSamples(scene, "hammersley", 32), exact);
}

TEST(DepthComplexity, OfAnotherSeedIsThatOfItsSamples) {
    const Scene scene = overlapScene();
    EXPECT_LE(errorOfSamples(scene, "halton", 16, 3), exact);
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "depth-complexity:n=16,pattern=halton", 1, 3);
    EXPECT_GT(meanErrorOfSamples(stage, v, techniques::lightPoints(scene.light, "halton", 16, 1)), 1e-3);
}

TEST(DepthComplexity, OfCastersThatOverlapHidesTheirUnion) { // dissertation 2.3.5, Figure 2.24
    const Scene scene = stripScene(touchingStrips);
    Stage stage(scene);
    stage.show(0);
    // 64 samples regular across the strips step by 1/64, and four borders of strips are seen.
    const auto points = stripPoints(stage, rendered(stage, "depth-complexity"), touchingStrips);
    for (const SlabPoint& point : points) EXPECT_NEAR(point.visibility, point.truth, 4.0 / 64);
    EXPECT_LE(rmsError(points), 0.01);
    const auto added = stripPoints(stage, rendered(stage, "penumbra-wedge"), touchingStrips);
    EXPECT_GT(rmsError(added), 2 * rmsError(points));
}

// ---- structure ----

TEST(DepthComplexity, OfNSamplesHasNPlusOneValues) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    std::array<std::size_t, 6> pixels{};
    for (const float x : rendered(stage, "depth-complexity:n=5")) {
        EXPECT_NEAR(5 * x, std::round(5 * x), 1e-5);
        ++pixels.at(static_cast<std::size_t>(std::lround(5 * x)));
    }
    for (const std::size_t count : pixels) EXPECT_GT(count, 0U);
}

TEST(DepthComplexity, HasWedgesOverTheSilhouettesOfTheWholeLight) {
    const Scene scene = cubeScene();
    Stage stage(scene);
    stage.show(0);
    // The light's middle sees the tops of cube and slab alone; the whole light the cube's sides, too, so that all its edges
    // and the diagonals of its four sides may be silhouettes.
    const auto figures = figuresOf(stage, "depth-complexity");
    EXPECT_EQ(figures.at("shadow_quads"), 4 + 4);
    EXPECT_EQ(figures.at("penumbra_wedges"), 12 + 4 + 4);
}

TEST(DepthComplexity, CountsManyLayersWithoutLosingAny) {
    Scene scene = groundScene(96);
    scene.light = {LightKind::Rectangle, {0.2, 6.1, 0.3}, {0, -1, 0}, {1.1, 0, 0}, {0, 0, 1.1}};
    Object pile = object(box({1, 0.002, 1}), {0, 0, 0});
    pile.instances.clear();
    for (int i = 0; i < 100; ++i)
        pile.instances.push_back({glm::translate(glm::dmat4(1), glm::dvec3(0.2, 1 + 0.01 * i, 0.3)), 0});
    scene.objects.push_back(pile);
    EXPECT_LE(errorOfSamples(scene, "hammersley", 16), exact);
}

// ---- cost ----

std::uint64_t fragmentsOf(Stage& stage, const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto technique = variant.entry->make(variant.parameters);
    stage.render(*technique, 0, 1);
    return timing::measurePasses(stage, *technique, 0, 1, 1).frame().work.fragments;
}

TEST(DepthComplexity, DrawsTheSameForAnyNumberOfSamplesAndMoreThanPenumbraWedges) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const auto few = fragmentsOf(stage, "depth-complexity:n=4");
    EXPECT_EQ(fragmentsOf(stage, "depth-complexity:n=64"), few); // each of them counts 16 times as many samples
    EXPECT_GT(few, fragmentsOf(stage, "penumbra-wedge"));
}

TEST(DepthComplexity, RefusesWhatItCannotAnswer) {
    for (const char* wrong : {"depth-complexity:n=0", "depth-complexity:n=257", "depth-complexity:pattern=disk"})
        EXPECT_THROW(techniques::parseVariant(wrong), BadInput) << wrong;
    Scene scene = halfPlaneScene();
    const techniques::Entry& entry = *techniques::parseVariant("depth-complexity").entry;
    EXPECT_FALSE(entry.notApplicable(scene));
    scene.light.kind = LightKind::Line;
    EXPECT_EQ(entry.notApplicable(scene), "needs a light with a width and a height; the light of test is a line");
}

} // namespace
} // namespace shadowbench
