// Bare passes: the least that a technique needs, beside what it does.
#include "harness/measure/frame_cost.h"
#include "scene/sky.h"
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
    const std::set<std::string> lacking{"vsm",
                                        "lvsm",
                                        "esm",
                                        "planar-soft",
                                        "sm-tiled",
                                        "sm-adaptive",
                                        "sm-dual-paraboloid",
                                        "sm-silhouette",
                                        "sm-alias-free",
                                        "penumbra-wedge",
                                        "csm-fourier",
                                        "deep-sm",
                                        "pcf-blur",
                                        "pcf-jitter",
                                        "single-sample",
                                        "shadow-width-map",
                                        "penumbra-map",
                                        "smoothie",
                                        "skirt",
                                        "backprojection",
                                        "bitmask",
                                        "backprojection-peeled",
                                        "convolution",
                                        "occlusion-texture",
                                        "sampled-maps",
                                        "sampled-volumes",
                                        "linear-visibility",
                                        "layered-attenuation",
                                        "soft-alias-free",
                                        "depth-complexity",
                                        "temporal-soft",
                                        "temporal-sampling",
                                        "prt-sh",
                                        "prt-haar"};
    std::set<std::string> without;
    for (const techniques::Entry& entry : techniques::catalog()) {
        if (!entry.make) continue; // levels of detail are compared with lod-switch
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
            "sm-focused:map=128",
            "sm-psm:map=128",
            "sm-lispsm:map=128",
            "sm-tsm:map=128",
            "sm-cascaded:map=128",
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
            "combined:map=128"};
}

class EveryBareBound : public testing::TestWithParam<std::string> {};

TEST_P(EveryBareBound, IsOfTheTechniquesPassesAndAsksForNoMoreThanThese) {
    const ComparedPasses passes = counted(GetParam());
    ASSERT_FALSE(passes.declared.empty());
    for (const BarePass& bare : passes.declared) {
        EXPECT_FALSE(bare.source.empty());
        EXPECT_NE(std::ranges::find(passes.own.passes, bare.pass, &timing::PassCost::name), passes.own.passes.end())
            << bare.pass << " is no pass of the technique";
    }
    EXPECT_LE(passes.bare.frame().work.fragments, passes.own.frame().work.fragments);
    EXPECT_LE(passes.bare.frame().work.vertices, passes.own.frame().work.vertices);
    EXPECT_LE(passes.bare.frame().work.draws, passes.own.frame().work.draws);
}

INSTANTIATE_TEST_SUITE_P(Declaring, EveryBareBound, testing::ValuesIn(declaringVariants()), nameOfText);

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
    timing::measureWork(stage, frames, 0, record);
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
        timing::measureWork(stage, frames, 0, record);
        if (timed) timing::measureTimes(stage, variant, frames, record);
        return record;
    };
    const Record without = recordOf("planar-soft", true);
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
