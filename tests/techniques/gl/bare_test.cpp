// Bare passes: the least that a technique needs, beside what it does.
#include "harness/measure/frame_cost.h"
#include "scene/sky.h"
#include "techniques/folder_passes.h"
#include "tests/support/stages.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {

using techniques::BarePass;
using timing::ComparedPasses;

constexpr int imageSide = 64;

/// A box over a ground under an area light: every technique that needs no sky has something to do.
Scene lampScene() {
    Scene scene = boxScene(imageSide);
    scene.light = {LightKind::Rectangle, {1.7, 6.1, -2.3}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    return scene;
}

Scene skyScene() {
    Scene scene = boxScene(imageSide);
    scene.light = environmentLight({ConstantSky{1}, {{{0, 1, 0}, 20, 1}}});
    return scene;
}

/// A warm frame's passes and bare passes, counted.
ComparedPasses counted(const Scene& scene, const std::string& variant) {
    Stage stage(scene);
    stage.show(0);
    const techniques::Variant parsed = techniques::parseVariant(variant);
    const auto technique = parsed.entry->make(parsed.parameters);
    timing::Sequence frames{*technique, 0, 1};
    for (; frames.index < 2; ++frames.index) stage.render(*technique, frames.index, frames.seed);
    return timing::countPasses(stage, frames);
}

ComparedPasses counted(const std::string& variant) {
    const bool needsSky = techniques::parseVariant(variant).entry->environment == techniques::EnvironmentAnswer::Only;
    return counted(needsSky ? skyScene() : lampScene(), variant);
}

const PassRecord& passNamed(const std::vector<PassRecord>& passes, const std::string& name) {
    return *std::ranges::find(passes, name, &PassRecord::name);
}

std::uint64_t tapsOf(const ComparedPasses& passes, const std::string& pass) {
    const std::vector<PassRecord> records = passes.records(false);
    return passNamed(records, pass).bare.value().taps;
}

constexpr std::uint64_t pixels = std::uint64_t{imageSide} * imageSide;

TEST(Bare, IsDeclaredByAllTechniquesButThese) {
    const std::set<std::string> lacking{
        // How many texels a pixel reads depends on what lies around it and on how its search is organised.
        "single-sample", "backprojection",
        // So does how many triangles a pixel is tested against.
        "sm-alias-free", "soft-alias-free",
        // What is drawn between discontinuities is found on the GPU alone.
        "linear-visibility"};
    std::set<std::string> without;
    for (const techniques::Entry& entry : techniques::catalog()) {
        if (!entry.make) continue; // levels of detail are compared with lod-switch
        if (!techniques::drawnWith(entry.id).empty()) continue; // folders declare none
        const bool mapped =
            std::ranges::find(entry.parameters, "map", &techniques::Parameter::name) != entry.parameters.end();
        if (counted(mapped ? entry.id + ":map=128" : entry.id).declared.empty()) without.insert(entry.id);
    }
    EXPECT_EQ(without, lacking);
}

/// Variants whose technique declares a bare bound.
std::vector<std::string> declaringVariants() {
    return {"none",
            "planar-hard",
            "planar-fake:map=128",
            "sm-uniform:map=128",
            "sm-midpoint:map=128",
            "sm-psm:map=128",
            "sm-lispsm:map=128",
            "sm-tsm:map=128",
            "sm-cascaded:fit=view,map=128",
            "sm-cube:map=128",
            "sm-history:map=128",
            "volume-zpass",
            "volume-zfail",
            "volume-zfail:far=infinity",
            "volume-xor",
            "pcf:map=128",
            "pcf:kernel=2,map=128",
            "pcf-poisson:map=128",
            "pcss:map=128",
            "combined:map=128",
            "planar-soft:n=4",
            "sm-dual-paraboloid:map=128",
            "sm-silhouette:map=128",
            "sm-tiled:map=128",
            "sm-adaptive:map=1024",
            "sm-adaptive:cache=off,map=256",
            "pcf-jitter:map=128",
            "pcf-blur:map=128",
            "deep-sm:map=128",
            "sampled-maps:n=4,map=128",
            "sampled-volumes:n=4",
            "temporal-sampling:map=128",
            "temporal-soft:map=128",
            "layered-attenuation:map=128",
            "penumbra-map:map=128",
            "smoothie:map=128",
            "skirt:map=128",
            "shadow-width-map:map=128",
            "bitmask:map=128",
            "bitmask:bits=256,map=128,samples=256,window=12",
            "backprojection-peeled:map=128",
            "penumbra-wedge",
            "penumbra-wedge:side=2",
            "depth-complexity"};
}

/// Those that reduce or filter by compute shaders, which have neither fragments nor draws.
std::vector<std::string> computingVariants() {
    return {"sm-cascaded:map=128",
            "vsm:map=128",
            "lvsm:map=128",
            "esm:map=128",
            "esm:kernel=32,map=128",
            "csm-fourier:map=128",
            "csm-fourier:map=128,terms=32",
            "occlusion-texture:map=128",
            "convolution:map=128",
            "prt-sh",
            "prt-sh:compression=clustered",
            "prt-haar:resolution=16"};
}

void expectPassesOfTheTechnique(const ComparedPasses& passes) {
    ASSERT_FALSE(passes.declared.empty());
    for (const BarePass& bare : passes.declared) {
        EXPECT_FALSE(bare.source.empty());
        EXPECT_NE(std::ranges::find(passes.own.passes, bare.pass, &timing::PassCost::name), passes.own.passes.end())
            << bare.pass << " is no pass of the technique";
    }
}

class EveryBareBound : public testing::TestWithParam<std::string> {};

TEST_P(EveryBareBound, IsOfTheTechniquesPassesAndAsksForNoMoreThanThese) {
    const ComparedPasses passes = counted(GetParam());
    expectPassesOfTheTechnique(passes);
    constexpr int branches = 1; // what some pixels do in a pass is a triangle of its own
    // Up to the blocks of 4 × 4 along the diagonals of screen triangles.
    EXPECT_LE(static_cast<double>(passes.bare.frame().work.fragments),
              1.02 * static_cast<double>(passes.own.frame().work.fragments));
    EXPECT_LE(passes.bare.frame().work.vertices, passes.own.frame().work.vertices + 3 * branches);
    EXPECT_LE(passes.bare.frame().work.draws, passes.own.frame().work.draws + branches);
}

INSTANTIATE_TEST_SUITE_P(Declaring, EveryBareBound, testing::ValuesIn(declaringVariants()), nameOfText);

class EveryBareBoundOfCompute : public testing::TestWithParam<std::string> {};

TEST_P(EveryBareBoundOfCompute, IsOfTheTechniquesPasses) { expectPassesOfTheTechnique(counted(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Declaring, EveryBareBoundOfCompute, testing::ValuesIn(computingVariants()), nameOfText);

TEST(Bare, OfAShadowMapIsTheCastersOnceAndATestForEachPixel) {
    const ComparedPasses passes = counted("sm-uniform:map=128");
    const std::vector<PassRecord> records = passes.records(false);
    const PassRecord &map = passNamed(records, "depth map"), &lookup = passNamed(records, "resolve");
    EXPECT_EQ(map.bare->vertices, 3 * snapshot(lampScene(), 0).triangles());
    EXPECT_EQ(map.bare->fragments, map.fragments) << "the same triangles through the same view";
    EXPECT_EQ(map.bare->taps, 0U);
    EXPECT_EQ(lookup.bare->fragments, lookup.fragments);
    EXPECT_EQ(lookup.bare->taps, 2 * pixels) << "the pixel's position, and the map";
    EXPECT_FALSE(passNamed(records, "G-buffer").bare) << "is on both sides";
}

TEST(Bare, OfFiltersReadsTheMapAsOftenAsTheirKernelsHaveTaps) {
    EXPECT_EQ(tapsOf(counted("pcf:kernel=7,map=128"), "resolve"), (1 + 49) * pixels);
    EXPECT_EQ(tapsOf(counted("pcf:kernel=2,map=128"), "resolve"), (1 + 1) * pixels) << "bilinear hardware";
    EXPECT_EQ(tapsOf(counted("pcss:taps=25+49,map=128"), "resolve"), (1 + 25 + 49) * pixels);
    EXPECT_EQ(tapsOf(counted("planar-fake:kernel=7,map=128"), "resolve"), (1 + 16) * pixels) << "4 × 4 bilinear reads";
}

TEST(Bare, OfAPrefilteredMapReadsEachTexelOnceAPassWhateverTheKernel) {
    constexpr std::uint64_t texels = 128 * 128, packed = texels / 2, third = 64 * 85;
    const ComparedPasses passes = counted("vsm:map=128");
    EXPECT_EQ(tapsOf(passes, "blur"), texels + packed + third) << "depths, two means a texel of the rows, mipmaps";
    EXPECT_EQ(tapsOf(passes, "resolve"), (1 + 1) * pixels);
    EXPECT_EQ(tapsOf(counted("vsm:kernel=3,map=128"), "blur"), tapsOf(passes, "blur"));
    EXPECT_EQ(tapsOf(counted("csm-fourier:map=128,terms=16"), "resolve"), (1 + 8) * pixels) << "two terms a texture";
}

TEST(Bare, OfABranchHasTheTapsOfThePixelsThatTakeIt) {
    constexpr std::uint64_t first = 8 + 4, all = 64 + 32; // tests, and texels of the jitter table with two offsets each
    const std::uint64_t taps = tapsOf(counted("pcf-jitter:map=128,radius=8"), "resolve");
    EXPECT_GT(taps, (1 + first) * pixels) << "some pixels lie in the penumbra";
    EXPECT_LT(taps, (1 + all) * pixels / 2) << "most do not";
}

TEST(Bare, OfASampledLightHasAMapForEachSampleAndOnePassOverAll) {
    const std::vector<PassRecord> records = counted("sampled-maps:n=4,map=128").records(false);
    EXPECT_EQ(passNamed(records, "depth map").bare->vertices, 4 * 3 * snapshot(lampScene(), 0).triangles());
    EXPECT_EQ(passNamed(records, "resolve").bare->taps, (1 + 4) * pixels);
    EXPECT_FALSE(passNamed(records, "shadow test").bare);
}

TEST(Bare, OfAnAdaptiveMapHasThePagesThatAreDrawn) {
    EXPECT_EQ(std::ranges::count(counted("sm-adaptive:map=1024").declared, "depth map", &BarePass::pass), 0)
        << "all are kept";
    const std::vector<PassRecord> records = counted("sm-adaptive:cache=off,map=256").records(false);
    const PassRecord& pages = passNamed(records, "depth map");
    EXPECT_EQ(pages.bare->vertices, pages.vertices);
}

TEST(Bare, IsNotTimedInTheTechniquesPlaceNorChangesWhatItShows) {
    const Scene scene = lampScene();
    Stage stage(scene);
    stage.show(0);
    const techniques::Variant variant = techniques::parseVariant("volume-zfail");
    const auto technique = variant.entry->make(variant.parameters);
    timing::Sequence frames{*technique, 0, 1};
    stage.render(*technique, frames.index++, 1);
    const Image<float> before = stage.visibility();
    Record record;
    timing::measureWork(stage, frames, record);
    timing::measureTimes(stage, variant, frames, record);
    stage.redraw();
    stage.render(*technique, 0, 1);
    EXPECT_EQ(stage.visibility(), before);
    EXPECT_GT(record.values["cost.time.bare"].value(), 0);
    EXPECT_GT(record.values["cost.time.bare_ratio"].value(), 0);
    EXPECT_GT(record.values["cost.time.processor"].value(), 0) << "finds the silhouettes";
    double shares = 0;
    std::uint64_t fragments = 0;
    for (const PassRecord& pass : record.passes) {
        shares += pass.share.value();
        fragments += pass.fragments;
    }
    EXPECT_NEAR(shares, 1, 1e-9);
    EXPECT_EQ(static_cast<double>(fragments), record.values["cost.work.fragments"]);
    EXPECT_EQ(record.passes.front().name, "G-buffer");
    EXPECT_EQ(record.passes.back().name, betweenPasses);
    EXPECT_FALSE(passNamed(record.passes, "silhouette volumes").bare) << "work of the processor";
}

TEST(Bare, IsAbsentWhereNoneIsDeclaredAndUntimedWhereNothingIs) {
    const Scene scene = lampScene();
    Stage stage(scene);
    stage.show(0);
    const auto recordOf = [&](const std::string& name, bool timed) {
        const techniques::Variant variant = techniques::parseVariant(name);
        const auto technique = variant.entry->make(variant.parameters);
        Record record;
        timing::Sequence frames{*technique, 0, 1};
        timing::measureWork(stage, frames, record);
        if (timed) timing::measureTimes(stage, variant, frames, record);
        return record;
    };
    const Record without = recordOf("single-sample:map=128", true);
    EXPECT_FALSE(without.values["cost.time.bare"]);
    EXPECT_FALSE(without.values["cost.time.bare_ratio"]);
    const Record untimed = recordOf("sm-uniform:map=128", false);
    for (const PassRecord& pass : untimed.passes) {
        EXPECT_FALSE(pass.milliseconds);
        EXPECT_FALSE(pass.share);
    }
    EXPECT_TRUE(passNamed(untimed.passes, "depth map").bare) << "its work is known";
    EXPECT_FALSE(passNamed(untimed.passes, "depth map").bare->milliseconds);
}

TEST(OtherScreen, ShowsWhatGrowsWithTheScreenAndWhatWithTheMap) {
    const Scene scene = boxScene(256);
    const techniques::Variant variant = techniques::parseVariant("sm-uniform:map=256");
    const OtherScreen other = timing::measureOtherScreen(scene, variant, 0, 1);
    EXPECT_EQ(other.width, 1024);
    EXPECT_EQ(other.height, 1024);
    const std::vector<PassRecord> own = counted(scene, "sm-uniform:map=256").records(false);
    EXPECT_EQ(passNamed(other.passes, "depth map").fragments, passNamed(own, "depth map").fragments);
    const auto sixteen = 16 * static_cast<double>(passNamed(own, "resolve").fragments);
    EXPECT_NEAR(static_cast<double>(passNamed(other.passes, "resolve").fragments), sixteen, 0.02 * sixteen)
        << "up to the blocks of 4 × 4 along the diagonal of the screen's triangle";
    EXPECT_GT(passNamed(other.passes, "resolve").milliseconds.value(), 0);

    EXPECT_EQ(timing::measureOtherScreen(boxScene(1024), variant, 0, 1).width, 256) << "of a large one a small one";
}

} // namespace
} // namespace shadowbench
