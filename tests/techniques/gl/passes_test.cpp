// Passes with names: what a listener learns, and what each pass of a frame costs.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "harness/measure/raster_clock.h"
#include "scene/sky.h"
#include "techniques/gl/api.h"
#include "tests/support/lod_scenes.h"
#include "tests/support/stages.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <tuple>
#include <utility>

namespace shadowbench {
namespace {

using techniques::Frame;
using techniques::PassListener;
using timing::FramePasses;
using timing::measurePasses;

/// A box over a ground under an area light: every technique has something to do.
Scene lampScene() {
    Scene scene = boxScene(64);
    scene.light = {LightKind::Rectangle, {1.7, 6.1, -2.3}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    return scene;
}

/// The same under a sky.
Scene skyScene() {
    Scene scene = boxScene(64);
    scene.light = environmentLight({ConstantSky{1}, {{{0, 1, 0}, 20, 1}}});
    return scene;
}

std::unique_ptr<techniques::Technique> made(const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    return variant.entry->make(variant.parameters);
}

constexpr int measured = 2; // the number of the frame that is measured; those before warm histories up

/// Pass by pass, of a fresh technique.
FramePasses passesOf(Stage& stage, const std::string& name) {
    const auto technique = made(name);
    for (int frame = 0; frame < measured; ++frame) stage.render(*technique, frame, 1);
    return measurePasses(stage, *technique, measured, 1, 1);
}

std::vector<std::string> namesOf(const FramePasses& frame) {
    std::vector<std::string> names;
    for (const timing::PassCost& pass : frame.passes) names.push_back(pass.name);
    return names;
}

void expectSum(const FramePasses& passes, const gl::WorkCount& whole) {
    const gl::WorkCount sum = passes.frame().work;
    EXPECT_EQ(sum.fragments, whole.fragments);
    EXPECT_EQ(sum.vertices, whole.vertices);
    EXPECT_EQ(sum.primitives, whole.primitives);
    EXPECT_EQ(sum.draws, whole.draws);
    EXPECT_EQ(sum.passes, whole.passes);
    EXPECT_EQ(passes.outside.work.draws, 0U) << "draws that belong to no pass";
    EXPECT_EQ(passes.outside.work.fragments, 0U);
    for (const timing::PassCost& pass : passes.passes) {
        EXPECT_FALSE(pass.name.empty());
        EXPECT_GE(pass.runs, 1) << pass.name;
        EXPECT_GT(pass.milliseconds, 0) << pass.name;
    }
}

class EveryTechnique : public testing::TestWithParam<std::string> {};

TEST_P(EveryTechnique, HasPassesThatAddUpToItsFrame) {
    const bool needsSky = techniques::parseVariant(GetParam()).entry->environment == techniques::EnvironmentAnswer::Only;
    const Scene scene = needsSky ? skyScene() : lampScene();
    Stage stage(scene);
    stage.show(0);
    const auto technique = made(GetParam());
    for (int frame = 0; frame < measured; ++frame) stage.render(*technique, frame, 1);
    gl::WorkMeter meter;
    stage.redraw();
    stage.render(*technique, measured, 1);
    const gl::WorkCount whole = meter.finish();
    expectSum(passesOf(stage, GetParam()), whole);
}

/// All of the catalogue, with small maps and few points of a transfer where they have these.
std::vector<std::string> shadowTechniques() {
    std::vector<std::string> variants;
    for (const techniques::Entry& entry : techniques::catalog()) {
        if (!entry.make) continue;
        std::string variant = entry.id;
        for (const auto& [parameter, value] : {std::pair("map", 128), std::pair("points", 256)})
            if (std::ranges::count(entry.parameters, parameter, &techniques::Parameter::name) > 0)
                variant += fmt::format("{}{}={}", variant == entry.id ? ':' : ',', parameter, value);
        variants.push_back(variant);
    }
    return variants;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryTechnique, testing::ValuesIn(shadowTechniques()), nameOfText);

TEST(Passes, HaveTheNamesOfTheField) {
    const Scene scene = lampScene();
    Stage stage(scene);
    stage.show(0);
    using Names = std::vector<std::string>;
    const std::map<std::string, Names> expected{
        {"none", {"G-buffer", "clear"}},
        {"planar-hard", {"G-buffer", "receiver stencil", "projected casters"}},
        {"sm-uniform", {"G-buffer", "depth map", "resolve"}},
        {"sm-midpoint", {"G-buffer", "depth map", "second depth", "resolve"}},
        {"sm-cascaded", {"G-buffer", "receiver bounds", "depth map", "resolve"}},
        {"sm-cascaded:fit=view", {"G-buffer", "depth map", "resolve"}},
        {"sm-tiled", {"G-buffer", "depth map", "demands", "tile choice", "resolve"}}, // the depth map twice
        {"sm-adaptive:cache=off", {"G-buffer", "demands", "refinement", "depth map", "resolve"}},
        {"sm-clipmap:cache=off", {"G-buffer", "page marking", "page allocation", "depth map", "resolve"}},
        {"sm-history", {"G-buffer", "depth map", "temporal resolve"}},
        {"sm-silhouette", {"G-buffer", "depth map", "silhouette edges", "silhouette map", "resolve"}},
        {"sm-alias-free", {"G-buffer", "pixel lists", "triangle tests", "resolve"}},
        {"frustum-traced", {"G-buffer", "receiver bounds", "pixel lists", "triangle tests", "resolve"}},
        {"sm-zpp", {"G-buffer", "silhouette volumes", "stencil count", "resolve"}},
        {"volume-zfail", {"G-buffer", "silhouette volumes", "stencil count", "resolve"}},
        {"volume-zfail:far=infinity", {"G-buffer", "depth prepass", "silhouette volumes", "stencil count", "resolve"}},
        {"vsm", {"G-buffer", "depth map", "blur", "resolve"}},
        {"pcf-blur", {"G-buffer", "depth map", "resolve", "blur"}}, // the blur twice
        {"deep-sm", {"G-buffer", "depth map", "deep texture", "resolve"}},
        {"single-sample", {"G-buffer", "depth map", "tile ids", "neighbourhood search"}},
        {"shadow-width-map", {"G-buffer", "depth map", "occluder map", "shadow width map", "resolve"}},
        {"skirt", {"G-buffer", "depth map", "edge filter", "skirt", "resolve"}},
        {"convolution", {"G-buffer", "blocker images", "summed areas", "convolution"}},
        {"occlusion-texture", {"G-buffer", "slices", "summed areas", "resolve"}},
        {"sampled-maps", {"G-buffer", "depth map", "shadow test", "resolve"}},
        {"linear-visibility",
         {"G-buffer", "depth map", "depth discontinuities", "visibility map", "shadow test", "resolve"}},
        {"layered-attenuation:map=128", {"G-buffer", "resolve"}}, // its map was built in an earlier frame
        {"soft-alias-free", {"G-buffer", "pixel lists", "triangle tests", "resolve"}},
        {"temporal-soft", {"G-buffer", "overscan G-buffer", "depth map", "temporal resolve", "crop"}},
        {"temporal-sampling", {"G-buffer", "overscan G-buffer", "depth map", "temporal resolve", "crop"}}};
    for (const auto& [variant, names] : expected) EXPECT_EQ(namesOf(passesOf(stage, variant)), names) << variant;
}

TEST(Passes, UnderASkyHaveTheNamesOfTheField) {
    const Scene scene = skyScene();
    Stage stage(scene);
    stage.show(0);
    for (const std::string variant : {"prt-sh:points=256", "prt-sh:compression=clustered,points=256", "prt-haar:points=256"})
        EXPECT_EQ(namesOf(passesOf(stage, variant)), (std::vector<std::string>{"G-buffer", "dot products", "lookup"}));
}

TEST(Passes, CountWhatTheyDraw) {
    const Scene scene = lampScene();
    Stage stage(scene);
    stage.show(0);
    const FramePasses frame = passesOf(stage, "sampled-maps:n=9,map=64");
    ASSERT_EQ(frame.passes.size(), 4U);
    const auto& [gbuffer, map, test, mean] = std::tie(frame.passes[0], frame.passes[1], frame.passes[2], frame.passes[3]);
    EXPECT_EQ(gbuffer.runs, 1);
    EXPECT_EQ(gbuffer.work.primitives, snapshot(scene, 0).triangles());
    EXPECT_EQ(map.runs, 9);
    EXPECT_EQ(map.work.primitives, 9 * snapshot(scene, 0).triangles());
    EXPECT_EQ(test.runs, 9);
    EXPECT_EQ(test.work.draws, 9U);
    EXPECT_GE(test.work.fragments, 9U * 64 * 64);
    EXPECT_EQ(mean.runs, 1);
    EXPECT_EQ(mean.work.draws, 1U);
}

/// What a method asks for, whoever programs it.
struct Asked {
    std::string variant;
    std::uint64_t maps;    // into which all of the scene is drawn
    std::uint64_t screens; // passes over all pixels of an image
};

TEST(Passes, DrawSceneAndImageAsOftenAsTheMethodAsks) {
    const Scene scene = lampScene();
    Stage stage(scene);
    stage.show(0);
    const std::uint64_t triangles = snapshot(scene, 0).triangles();
    const std::vector<Asked> all{{"none", 0, 0},
                                 {"planar-fake:map=128", 1, 1},
                                 {"sm-uniform:map=128", 1, 1},
                                 {"sm-focused:map=128", 1, 1},
                                 {"sm-psm:map=128", 1, 1},
                                 {"sm-lispsm:map=128", 1, 1},
                                 {"sm-tsm:map=128", 1, 1},
                                 {"sm-midpoint:map=128", 2, 1},
                                 {"sm-history:map=128", 1, 1},
                                 {"pcf:map=128", 1, 1},
                                 {"pcf:kernel=7,map=128", 1, 1},
                                 {"pcf-poisson:map=128", 1, 1},
                                 {"pcf-jitter:map=128", 1, 1},
                                 {"pcf-blur:map=128", 1, 3},
                                 {"vsm:map=128", 1, 1},
                                 {"lvsm:map=128", 1, 1},
                                 {"esm:map=128", 1, 1},
                                 {"csm-fourier:map=128", 1, 1},
                                 {"pcss:map=128", 1, 1},
                                 {"combined:map=128", 1, 1},
                                 {"sampled-maps:map=128,n=4", 4, 5},
                                 {"occlusion-texture:map=128", 1, 1}};
    for (const auto& [variant, maps, screens] : all) {
        const FramePasses frame = passesOf(stage, variant);
        EXPECT_EQ(frame.frame().work.primitives, (1 + maps) * triangles + screens) << variant << ", with the G-buffer";
        const std::uint64_t image = screens > 0 ? 64 * 64 : 0; // that the last of them covers
        EXPECT_GE(frame.passes.back().work.fragments, image) << variant;
    }
}

TEST(LodPasses, AddUpToTheFrame) {
    const Scene scene = crossesScene(0.3);
    const std::map<std::string, std::vector<std::string>> expected{{"lod-full", {"opaque levels"}},
                                                                   {"lod-switch", {"opaque levels"}},
                                                                   {"lod-blend", {"opaque levels", "blended levels"}},
                                                                   {"lod-frame-sequential", {"LOD buffer", "combination"}}};
    for (const auto& [name, names] : expected) {
        const techniques::Variant variant = techniques::parseVariant(name);
        lod::LodStage stage(scene, scene.size);
        const auto whole = variant.entry->makeLod(variant.parameters), cut = variant.entry->makeLod(variant.parameters);
        for (const auto& technique : {whole.get(), cut.get()}) stage.render(*technique);
        gl::WorkMeter meter;
        stage.render(*whole);
        const gl::WorkCount count = meter.finish();
        const FramePasses passes = measurePasses(stage, *cut, 1);
        EXPECT_EQ(namesOf(passes), names);
        expectSum(passes, count);
    }
}

/// Passes that keep the processor busy, or wrongly nest.
class Busy final : public techniques::Technique {
public:
    explicit Busy(bool nested) : nested_(nested) {}
    void render(const Frame& frame, const gl::Texture&) override {
        {
            const auto pass = frame.pass("slow");
            const double start = timing::rasterMilliseconds();
            while (timing::rasterMilliseconds() < start + 20) {
            }
            if (nested_) const auto inner = frame.pass("inner");
        }
        const auto pass = frame.pass("fast");
    }

private:
    bool nested_;
};

TEST(Passes, TakeTheTimeOfTheProcessorToo) {
    const Scene scene = boxScene(16);
    Stage stage(scene);
    stage.show(0);
    Busy busy(false);
    const FramePasses frame = measurePasses(stage, busy, 0, 1, 3);
    ASSERT_EQ(namesOf(frame), (std::vector<std::string>{"G-buffer", "slow", "fast"}));
    EXPECT_GE(frame.passes[1].milliseconds, 20);
    EXPECT_LT(frame.passes[2].milliseconds, 10);
    EXPECT_GE(frame.frame().milliseconds, frame.passes[1].milliseconds + frame.passes[2].milliseconds);
}

TEST(Passes, DoNotNest) {
    const Scene scene = boxScene(16);
    Stage stage(scene);
    stage.show(0);
    Busy nested(true);
    try {
        measurePasses(stage, nested, 0, 1, 1);
        FAIL() << "measured";
    } catch (const InternalError& error) {
        EXPECT_STREQ(error.what(), "the pass \"inner\" begins within another; passes do not nest");
    }
    EXPECT_NO_THROW(stage.render(nested, 0, 1)); // nobody adds anything up
}

/// Notes how many debug groups are open in each pass.
class GroupDepths final : public PassListener {
public:
    void begin(std::string_view) override { depths.push_back(depth()); }
    void end(std::string_view) override { depths.push_back(depth()); }
    static int depth() {
        GLint groups = 0;
        glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &groups);
        return groups;
    }
    std::vector<int> depths;
};

/// Notes the depth within its only pass.
class Probe final : public techniques::Technique {
public:
    void render(const Frame& frame, const gl::Texture&) override {
        const auto pass = frame.pass("probe");
        within = GroupDepths::depth();
    }
    int within = 0;
};

TEST(Passes, AreDebugGroupsForGpuProfilers) {
    const Scene scene = boxScene(16);
    Stage stage(scene);
    stage.show(0);
    const int before = GroupDepths::depth();
    Probe probe;
    GroupDepths listener;
    stage.render(probe, 0, 1, &listener);
    EXPECT_EQ(probe.within, before + 1);
    EXPECT_EQ(listener.depths, (std::vector<int>{before, before}));
}

} // namespace
} // namespace shadowbench
