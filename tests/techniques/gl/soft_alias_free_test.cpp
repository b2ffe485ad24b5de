// Alias-free lists with the hidden light samples as bits: the truth of the samples themselves, whatever casts.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "tests/support/sample_truth.h"
#include "tests/support/soft_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(SoftAliasFree, EqualsTheExactVisibilityOfItsOwnSamples) {
    for (const Scene& scene : {halfPlaneScene(), overlapScene()}) {
        Stage stage(scene);
        stage.show(0);
        for (const auto& [pattern, n] : {std::pair{"hammersley", 64}, {"halton", 33}, {"grid", 25}}) {
            const Image<float> v = rendered(stage, fmt::format("soft-alias-free:n={},pattern={}", n, pattern));
            EXPECT_LE(meanErrorOfSamples(stage, v, samplesOf(scene, pattern, n)), rasterised) << pattern;
        }
    }
}

TEST(SoftAliasFree, OfAnotherSeedIsThatOfItsSamples) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "soft-alias-free:n=16,pattern=halton", 1, 3);
    EXPECT_LE(meanErrorOfSamples(stage, v, samplesOf(scene, "halton", 16, 3)), rasterised);
    EXPECT_GT(meanErrorOfSamples(stage, v, samplesOf(scene, "halton", 16, 1)), 10 * rasterised);
}

TEST(SoftAliasFree, NeedsNoClosedMeshes) { // as stencil volumes do
    const Mesh up = plane(0.8);
    Mesh down = up;
    for (glm::uvec3& triangle : down.triangles) std::swap(triangle.y, triangle.z);
    for (const Mesh& sheet : {up, down}) {
        const Scene scene = openMeshScene(sheet);
        Stage stage(scene);
        stage.show(0);
        const Image<float> v = rendered(stage, "soft-alias-free:n=16");
        EXPECT_LE(meanErrorOfSamples(stage, v, samplesOf(scene, "hammersley", 16)), rasterised);
    }
}

TEST(SoftAliasFree, HoldsBeforeAndBehindASlantedLight) {
    Scene scene = overlapScene();
    scene.light = {LightKind::Rectangle, {1.9, 3.6, 0.3}, {0, -1, 0}, {0.1, 0.2, 1.1}, {0.5, 0.9, 0}};
    scene.objects.push_back(object(box({3, 0.01, 3}), {2, 3.6, 0.3})); // cuts through the light: hides its upper half
    scene.objects.push_back(object(box({0.1, 1.4, 0.8}), {3.1, 1.2, 0.4}));
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "soft-alias-free:n=16");
    EXPECT_LE(meanErrorOfSamples(stage, v, samplesOf(scene, "hammersley", 16)), rasterised);
}

TEST(SoftAliasFree, HoldsUnderALinearLight) {
    Scene scene = overlapScene();
    scene.light = {LightKind::Line, {0.4, 6, 0.2}, {0, -1, 0}, {1.3, 0, 0.2}, {}};
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "soft-alias-free:n=16");
    EXPECT_LE(meanErrorOfSamples(stage, v, samplesOf(scene, "hammersley", 16)), rasterised);
}

TEST(SoftAliasFree, ThePenumbraUnderAHalfPlaneIsLinear) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    // 64 samples regular across the edge step by 1/64: an error of 1/64/√12 = 0.0045, and nothing is added to it.
    EXPECT_LE(penumbraRmsError(slabPoints(stage, rendered(stage, "soft-alias-free"))), 0.008);
}

TEST(SoftAliasFree, OfNSamplesHasNPlusOneValues) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    std::array<std::size_t, 6> pixels{};
    for (const float x : rendered(stage, "soft-alias-free:n=5")) {
        EXPECT_NEAR(5 * x, std::round(5 * x), 1e-5);
        ++pixels.at(static_cast<std::size_t>(std::lround(5 * x)));
    }
    for (const std::size_t count : pixels) EXPECT_GT(count, 0U);
}

TEST(SoftAliasFree, TheGridChangesNothing) { // cells are as good as any others, and so is a test of every pixel
    Scene scene = overlapScene();
    scene.light.kind = LightKind::Rectangle; // with samples in its corners
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "soft-alias-free");
    for (const char* grid : {"1", "7", "1000"})
        EXPECT_EQ(rendered(stage, fmt::format("soft-alias-free:grid={}", grid)), v) << grid;
}

TEST(SoftAliasFree, TestsAsManyLargeTrianglesAsThereAre) { // in several dispatches, none with more rounds than llvmpipe runs
    Scene scene = groundScene(16);
    scene.light = {LightKind::Rectangle, {0.4, 6, 0.2}, {0, -1, 0}, {1.3, 0, 0}, {0, 0, 1.3}};
    scene.objects.push_back(object(sphere(0.5, 62'000), {0.13, 1.2, 0.21}));
    scene.objects.push_back(object(plane(0.8), {-1.4, 1.2, 0.4})); // the last ones
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(rendered(stage, "soft-alias-free:grid=1"), rendered(stage, "soft-alias-free"));
}

double testsOf(Stage& stage, const std::string& variant) { return figuresOf(stage, variant).at("tests"); }

double pixelsSeen(const Stage& stage) {
    const metrics::Drawn drawn = stage.drawn();
    return static_cast<double>(std::count_if(drawn.id.begin(), drawn.id.end(), [](unsigned id) { return id != 0; }));
}

TEST(SoftAliasFree, CostsTheTilesThatATriangleMayShadeWithoutLists) { // and with them a small part of it
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> before = rendered(stage, "soft-alias-free:grid=1");
    const double all = pixelsSeen(stage) * static_cast<double>(stage.shown().triangles());
    const double ofTiles = testsOf(stage, "soft-alias-free:grid=1");
    EXPECT_LT(ofTiles, 0.5 * all);
    EXPECT_EQ(stage.visibility(), before);
    // The three boxes' faces of two triangles each; the body's are small.
    EXPECT_LT(testsOf(stage, "soft-alias-free"), 0.5 * ofTiles);
}

TEST(SoftAliasFree, CostsMoreTheFartherThePenumbraReaches) {
    Scene scene = overlapScene();
    const auto tests = [&](double size) {
        scene.light.u = {size, 0, 0};
        scene.light.v = {0, 0, size};
        Stage stage(scene);
        stage.show(0);
        return testsOf(stage, "soft-alias-free");
    };
    const double small = tests(0.1), large = tests(2);
    EXPECT_GT(large, 2 * small);
}

TEST(SoftAliasFree, RefusesCountsAndGridsThatThereAreNot) {
    for (const char* wrong :
         {"soft-alias-free:n=0", "soft-alias-free:n=257", "soft-alias-free:grid=0", "soft-alias-free:map=64"})
        EXPECT_THROW(techniques::parseVariant(wrong), BadInput) << wrong;
}

} // namespace
} // namespace shadowbench
