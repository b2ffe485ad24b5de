// SPIR-V as it comes out of GLSL, and as it is read.
#include "gpu/module.h"
#include "tests/gpu/shaders.h"

#include "gpu/spirv.h"

#include <algorithm>

namespace shadowbench::gpu {
namespace {

Module moduleOf(Stage stage, const std::string& text) {
    return readModule(toSpirv({{stage, "test", text}}).front(), "test");
}

/// The sentence of the BadInput that `call` throws.
template <typename Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

TEST(Modules, HaveTheResourcesOfTheirShaders) {
    const Module module =
        moduleOf(Stage::Fragment, "#version 450 core\n"
                                  "layout(set = 0, binding = 0) uniform sampler2D map;\n"
                                  "layout(set = 0, binding = 1) uniform sampler2DArray maps[3];\n"
                                  "layout(set = 1, binding = 0) uniform texture2D image;\n"
                                  "layout(set = 1, binding = 1) uniform sampler sampling;\n"
                                  "layout(set = 1, binding = 2, rgba8) uniform image2D picture;\n"
                                  "layout(set = 2, binding = 5) uniform samplerBuffer texels;\n"
                                  "layout(set = 2, binding = 6, r32f) uniform imageBuffer stored;\n"
                                  "layout(std140, set = 2, binding = 7) uniform Block { vec4 b; };\n"
                                  "layout(std430, set = 2, binding = 8) buffer Stored { vec4 c[]; };\n"
                                  "layout(push_constant) uniform Pushed { vec4 d; };\n"
                                  "layout(location = 0) out vec4 colour;\nvoid main() {\n"
                                  "    colour = texture(map, b.xy) + texture(maps[1], b.xyz) + c[2] + d;\n"
                                  "    colour += texture(sampler2D(image, sampling), b.xy) + texelFetch(texels, 1);\n"
                                  "    colour += imageLoad(picture, ivec2(0)) + imageLoad(stored, 1);\n}\n");
    struct Expected {
        unsigned set, number;
        Resource resource;
        unsigned count;
    };
    const std::vector<Expected> expected{
        {0, 0, Resource::SampledImage, 1},  {0, 1, Resource::SampledImage, 3},  {1, 0, Resource::Image, 1},
        {1, 1, Resource::Sampler, 1},       {1, 2, Resource::StorageImage, 1},  {2, 5, Resource::UniformTexels, 1},
        {2, 6, Resource::StorageTexels, 1}, {2, 7, Resource::UniformBuffer, 1}, {2, 8, Resource::StorageBuffer, 1}};
    ASSERT_EQ(module.bindings.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(module.bindings[i].set, expected[i].set) << i;
        EXPECT_EQ(module.bindings[i].number, expected[i].number) << i;
        EXPECT_EQ(module.bindings[i].resource, expected[i].resource) << i;
        EXPECT_EQ(module.bindings[i].count, expected[i].count) << i;
    }
    EXPECT_TRUE(module.pushConstants);
    EXPECT_EQ(module.entry, "main");
}

TEST(Modules, HaveALocationForEachColumnAndMember) {
    const Module module = moduleOf(Stage::Vertex, "#version 450 core\nlayout(location = 1) in mat3x4 world;\n"
                                                  "layout(location = 6) in uvec2 id;\nstruct S { float a; ivec3 b; };\n"
                                                  "layout(location = 2) flat out S s;\nvoid main() {\n"
                                                  "    s = S(world[0].x, ivec3(id, 1));\n    gl_Position = world[2];\n}\n");
    ASSERT_EQ(module.inputs.size(), 4U);
    EXPECT_EQ(module.inputs[2].location, 3U);
    EXPECT_EQ(module.inputs[2].components, 4U);
    EXPECT_EQ(module.inputs[3].scalar, Scalar::Uint);
    ASSERT_EQ(module.outputs.size(), 2U) << "gl_Position has no location";
    EXPECT_EQ(module.outputs[1].location, 3U);
    EXPECT_EQ(module.outputs[1].scalar, Scalar::Int);
    EXPECT_EQ(module.outputs[1].components, 3U);
}

TEST(Modules, MatchLocationsBetweenStagesByName) {
    const auto modules = toSpirv({{Stage::Vertex, "v",
                                   "#version 450 core\nout vec2 left; out vec3 kept; flat out uint id;\nvoid main() {\n"
                                   "    left = vec2(1); kept = vec3(gl_VertexID); id = uint(gl_InstanceID); gl_Position = "
                                   "vec4(0);\n}\n"},
                                  {Stage::Fragment, "f",
                                   "#version 450 core\nflat in uint id; in vec3 kept; out vec4 colour;\n"
                                   "void main() { colour = vec4(kept, id); }\n"}});
    const Module vertex = readModule(modules[0], "v"), fragment = readModule(modules[1], "f");
    ASSERT_EQ(fragment.inputs.size(), 2U);
    for (const Variable& input : fragment.inputs) {
        const auto output = std::ranges::find(vertex.outputs, input.location, &Variable::location);
        ASSERT_NE(output, vertex.outputs.end());
        EXPECT_EQ(output->scalar, input.scalar);
        EXPECT_EQ(output->components, input.components);
    }
}

TEST(Modules, BrokenGlslIsRefusedWithFileAndLine) {
    const std::string sentence = refusal([] {
        (void)toSpirv({{Stage::Fragment, "blur.frag",
                        "#version 450 core\nout vec4 colour;\nvoid main() {\n    colour = blurred;\n}\n"}});
    });
    EXPECT_NE(sentence.find("blur.frag:4:"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("blurred"), std::string::npos) << sentence;
}

TEST(Modules, WhatIsNoModuleIsRefused) {
    EXPECT_NE(refusal([] { (void)readModule({}, "a.spv"); }).find("a.spv is no valid SPIR-V"), std::string::npos);
    EXPECT_NE(refusal([] {
                  (void)readModule({0x07230203, 0x00010300, 0, 9, 0, 0x00020011}, "a.spv");
              }).find("a.spv"),
              std::string::npos);
    std::vector<std::uint32_t> cut = toSpirv({{Stage::Fragment, "t", fragment("x += 1;")}}).front();
    cut.resize(cut.size() - 7);
    EXPECT_NE(refusal([&] { (void)readModule(cut, "a.spv"); }).find("a.spv is no valid SPIR-V"), std::string::npos);
}

TEST(Modules, AnArrayWhoseSizeIsComputedIsRefused) {
    const std::string sentence = refusal([] {
        (void)moduleOf(Stage::Fragment, "#version 450 core\nlayout(constant_id = 0) const int n = 2;\n"
                                        "layout(location = 0) in float a[n + 1];\nlayout(location = 0) out vec4 c;\n"
                                        "void main() { c = vec4(a[1]); }\n");
    });
    EXPECT_NE(sentence.find("test declares a resource, input or output of a type that is not known here"), std::string::npos)
        << sentence;
}

TEST(Pipelines, ShadersOfOneStageMakeNone) {
    const Shader shader{Stage::Fragment, "a.frag", fragment("x += 1;")};
    EXPECT_NE(refusal([&] { (void)pipelineOf({shader, shader}); }).find("of one stage"), std::string::npos);
}

TEST(Pipelines, OneDigestForOneText) {
    const auto digest = [](const std::string& name, const std::string& body) {
        return pipelineOf({{Stage::Fragment, name, fragment(body)}}).digest();
    };
    EXPECT_EQ(digest("a", "x += 1;"), digest("b", "x += 1;"));
    EXPECT_NE(digest("a", "x += 1;"), digest("a", "x += 2;"));
    Pipeline pipeline = pipelineOf({{Stage::Fragment, "a", fragment("x += 1;")}});
    const std::string before = pipeline.digest();
    pipeline.state.colours.at(0).writeMask = 7;
    EXPECT_NE(pipeline.digest(), before);
}

} // namespace
} // namespace shadowbench::gpu
