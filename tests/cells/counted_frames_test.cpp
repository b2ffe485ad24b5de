// Frames whose waves are counted are the frames: marks in shaders change no bit of an image.
#include "gpu/counter.h"
#include "gpu/observer.h"
#include "harness/render/stage.h"
#include "studies/shader_cost/frame_pipelines.h"
#include "tests/support/cell_stage.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench {
namespace {

constexpr std::uint32_t seed = 1;

Scene smallScene(const std::string& id, int side) {
    Scene scene = loadScene(id, Profile::Gate);
    scene.size = {side, side};
    return scene;
}

/// The visibility of two frames, one after another, and how many of their pipelines were counted.
struct Drawn {
    std::vector<Image<float>> images;
    std::ptrdiff_t counted = 0;
};

Drawn draw(const Scene& scene, const techniques::Variant& variant, gpu::Counter* counter) {
    Stage stage(scene);
    const auto technique = variant.entry->make(variant.parameters);
    stage.show(0);
    gpu::Observer observer(counter);
    Drawn drawn;
    for (int frame = 0; frame < 2; ++frame) {
        stage.redraw();
        stage.render(*technique, frame, seed);
        drawn.images.push_back(stage.visibility());
    }
    drawn.counted = std::ranges::count_if(observer.take(), [](const gpu::Use& use) { return !use.passes.empty(); });
    return drawn;
}

TEST(CountedFrames, AreThoseOfTheTechniqueToTheBit) {
    testContext();
    const Scene scene = smallScene("simple", 96);
    std::ptrdiff_t counted = 0, variants = 0;
    // Every kind of shader: searches, discards, lists of triangles, geometry of shadow volumes, compute, a history.
    for (const char* name : {"sm-uniform", "sm-alias-free", "pcf-poisson", "vsm", "pcss", "single-sample", "skirt",
                             "bitmask", "convolution", "penumbra-wedge", "volume-zfail", "temporal-soft"}) {
        const techniques::Variant variant = techniques::parseVariant(name);
        SCOPED_TRACE(variant.name);
        ++variants;
        const Drawn plain = draw(scene, variant, nullptr);
        gpu::Counter counter;
        const Drawn marked = draw(scene, variant, &counter);
        EXPECT_EQ(plain.counted, 0);
        counted += marked.counted;
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_EQ(std::memcmp(plain.images[i].data(), marked.images[i].data(), 96 * 96 * sizeof(float)), 0)
                << "frame " << i;
    }
    EXPECT_GT(counted, variants) << "most techniques loop or branch somewhere";
}

TEST(CountedFrames, CountTheSameInEveryRun) {
    testContext();
    const Scene scene = smallScene("overlapping-occluders", 64);
    for (const char* name : {"pcss", "single-sample", "soft-alias-free"}) {
        const techniques::Variant variant = techniques::parseVariant(name);
        const auto first = shaders::pipelinesOf(scene, variant), second = shaders::pipelinesOf(scene, variant);
        ASSERT_EQ(first.uses.size(), second.uses.size());
        for (std::size_t i = 0; i < first.uses.size(); ++i) {
            EXPECT_EQ(first.uses[i].passes.waves32, second.uses[i].passes.waves32) << name;
            EXPECT_EQ(first.uses[i].passes.waves64, second.uses[i].passes.waves64) << name;
            EXPECT_EQ(first.uses[i].passes.longest64, second.uses[i].passes.longest64) << name;
        }
        EXPECT_TRUE(first.isCounted);
    }
}

TEST(CountedFrames, InMotionDrawWhatACacheSavesOtherwise) {
    testContext();
    const Scene scene = smallScene("simple", 64);
    const auto drawsOfMap = [&](shaders::CountedFrame frame, const char* technique) {
        std::uint64_t draws = 0;
        for (const gpu::Use& use : shaders::pipelinesOf(scene, techniques::parseVariant(technique), frame).uses)
            if (use.pass == "depth map") draws += use.draws;
        return draws;
    };
    EXPECT_EQ(drawsOfMap(shaders::CountedFrame::Standing, "sm-adaptive"), 0U) << "its pages are kept";
    EXPECT_GT(drawsOfMap(shaders::CountedFrame::InMotion, "sm-adaptive"), 0U);
    EXPECT_GT(drawsOfMap(shaders::CountedFrame::First, "sm-adaptive"), 0U);
    EXPECT_EQ(drawsOfMap(shaders::CountedFrame::InMotion, "sm-uniform"),
              drawsOfMap(shaders::CountedFrame::Standing, "sm-uniform"));
}

TEST(CountedFrames, DispatchesAreCountedOnALargerImageToo) {
    testContext();
    const shaders::FrameUses frame =
        shaders::pipelinesOf(smallScene("overlapping-occluders", 64), techniques::parseVariant("sm-alias-free"));
    std::ptrdiff_t dispatches = 0;
    for (const gpu::Use& use : frame.uses) {
        const gpu::Use* larger = frame.larger(use);
        if (use.pipeline.shaders.front().stage != gpu::Stage::Compute || use.draws == 0) {
            EXPECT_EQ(larger, nullptr);
            continue;
        }
        ASSERT_NE(larger, nullptr);
        ++dispatches;
        EXPECT_EQ(larger->draws, use.draws);
        EXPECT_GE(larger->passes.waves64.at(0), use.passes.waves64.at(0));
    }
    EXPECT_EQ(dispatches, 3) << "lists of pixels, triangles, large triangles";
}

TEST(CountedFrames, NameWhatTheyShowAndTheShadersThatTheyCompiled) {
    testContext();
    const Scene scene = smallScene("simple", 64);
    Scene moved = scene;
    moved.light.centre.x += 0.1;
    const auto of = [](const Scene& shown, const char* name) {
        return shaders::pipelinesOf(shown, techniques::parseVariant(name));
    };
    const shaders::FrameUses pcf = of(scene, "pcf");
    EXPECT_EQ(pcf.frame.size(), 12U);
    EXPECT_EQ(of(scene, "sm-uniform").frame, pcf.frame);
    EXPECT_NE(of(smallScene("simple", 32), "pcf").frame, pcf.frame);
    EXPECT_NE(of(moved, "pcf").frame, pcf.frame);
    for (const char* file : {"filtered/pcf/pcf.frag", "shared/filters/pcf.glsl", "gl/gbuffer.frag"})
        EXPECT_TRUE(pcf.shaderFiles.contains(file)) << file;
    EXPECT_FALSE(pcf.shaderFiles.contains("shared/maps/single_map.frag")) << "of what was drawn before";
}

TEST(CountedFrames, AreKeptByTheTextsOfTheirShaders) {
    EXPECT_EQ(shaders::textsOf({"gl/receiver.glsl"}), shaders::textsOf({"gl/receiver.glsl", "no/shader.glsl"}));
    EXPECT_NE(shaders::textsOf({"gl/receiver.glsl"}), shaders::textsOf({"gl/normal.glsl"}));
    EXPECT_NE(shaders::textsOf({"gl/receiver.glsl"}), shaders::textsOf({"gl/receiver.glsl", "gl/normal.glsl"}));
}

} // namespace
} // namespace shadowbench
