// What the compiler says against what must be so of any compiler.
#include "tests/gpu/shaders.h"

namespace shadowbench::gpu {
namespace {

std::string times(int count, const std::string& line) {
    std::string all;
    for (int i = 0; i < count; ++i) all += line;
    return all;
}

TEST_F(Compiling, TwiceTheArithmeticIsTwiceTheInstructions) {
    for (const Architecture& architecture : architectures()) {
        const std::string id(architecture.id);
        const auto of = [&](int count) {
            StageFigures f = figures(Stage::Fragment, fragment(times(count, "x = sqrt(x); ")), id);
            EXPECT_EQ(f.stage, Stage::Fragment);
            return f;
        };
        const auto none = of(0), once = of(20), twice = of(40);
        const auto more = once.of("Instructions") - none.of("Instructions");
        EXPECT_GE(more, 80U) << id << ": four roots in each of 20 lines";
        EXPECT_LE(more, 100U) << id;
        EXPECT_NEAR(static_cast<double>(twice.of("Instructions") - none.of("Instructions")), 2.0 * static_cast<double>(more),
                    8)
            << id;
        EXPECT_GT(twice.of("Inverse Throughput"), once.of("Inverse Throughput")) << id;
        EXPECT_GT(twice.of("Latency"), once.of("Latency")) << id;
    }
}

TEST_F(Compiling, ALoopBranchesAndStraightCodeDoesNot) {
    const auto straight = figures(Stage::Fragment, fragment("x = sqrt(x);"));
    const auto loop = figures(Stage::Fragment, fragment("for (int i = 0; i < count; ++i) x = sqrt(x) + texture(map, x.xy);",
                                                        "uniform int count; uniform sampler2D map;"));
    EXPECT_EQ(straight.of("Branches"), 0U);
    EXPECT_GE(loop.of("Branches"), 1U);
    EXPECT_GE(loop.of("VMEM Clause"), 1U);
}

TEST_F(Compiling, MoreLiveValuesTakeMoreRegistersAndLeaveFewerWaves) {
    // All are read before the first is used, in an order that the shader chooses.
    const auto of = [&](int count) {
        const std::string n = std::to_string(count);
        return figures(Stage::Compute, "#version 450 core\nlayout(local_size_x = 64) in;\n"
                                       "layout(std430, binding = 0) buffer In { vec4 a[]; };\n"
                                       "layout(std430, binding = 1) buffer Out { vec4 b[]; };\nvoid main() {\n"
                                       "    uint at = gl_GlobalInvocationID.x * " +
                                           n + "u;\n    vec4 v[" + n +
                                           "];\n"
                                           "    for (int i = 0; i < " +
                                           n +
                                           "; ++i) v[i] = a[at + i];\n    barrier();\n"
                                           "    for (int i = 0; i < " +
                                           n + "; ++i) b[at + i] = v[" + n + " - 1 - i];\n}\n");
    };
    const auto few = of(4), many = of(40), tooMany = of(100);
    EXPECT_GE(few.of("VGPRs"), 16U);
    EXPECT_GE(many.of("VGPRs"), 160U);
    EXPECT_LT(many.of("Subgroups per SIMD"), few.of("Subgroups per SIMD"));
    EXPECT_EQ(many.of("Spilled VGPRs"), 0U);
    EXPECT_GT(tooMany.of("Spilled VGPRs") + tooMany.of("Scratch size"), 0U);
}

TEST_F(Compiling, SharedMemoryIsCounted) {
    const auto f =
        figures(Stage::Compute, "#version 450 core\nlayout(local_size_x = 64) in;\nshared float kept[1024];\n"
                                "layout(std430, binding = 0) buffer Out { float b[]; };\nvoid main() {\n"
                                "    kept[gl_LocalInvocationIndex] = b[gl_LocalInvocationIndex];\n    barrier();\n"
                                "    b[gl_LocalInvocationIndex] = kept[63u - gl_LocalInvocationIndex] + kept[1000];\n}\n");
    EXPECT_GE(f.of("LDS size"), 4096U);
}

TEST_F(Compiling, ResourcesOfAllKindsCompile) {
    const auto f = figures(
        Stage::Fragment,
        fragment("x += texture(map, x.xy) + texture(maps[2], x.xyz) + vec4(texture(shadow, x.xyz)) + a + b[int(x.w)];\n"
                 "    x += texelFetch(texels, 3) + imageLoad(picture, ivec2(1));\n"
                 "    imageStore(picture, ivec2(x.xy), x); c[1] = x;",
                 "uniform vec4 a; uniform sampler2D map; uniform sampler2DArray maps[3]; uniform sampler2DShadow shadow;\n"
                 "uniform samplerBuffer texels; layout(rgba32f) uniform image2D picture;\n"
                 "layout(std140, binding = 9) uniform Block { vec4 b[4]; };\n"
                 "layout(std430, binding = 4) buffer Stored { vec4 c[]; };"));
    EXPECT_GT(f.of("Instructions"), 20U);
}

TEST_F(Compiling, WhatNoCalledFunctionReadsTakesNoBinding) {
    const auto f = figures(Stage::Fragment, fragment("x += texture(map, x.xy) + a;",
                                                     "uniform sampler2D unused; uniform vec4 a; uniform sampler2D map;\n"
                                                     "vec4 notCalled() { return texture(unused, vec2(0)); }"));
    EXPECT_GT(f.of("Instructions"), 5U);
}

TEST_F(Compiling, TheSameTwice) {
    const std::string text = fragment(times(9, "x = sqrt(x) * x.yxwz; "));
    EXPECT_EQ(toText({figures(Stage::Fragment, text)}), toText({figures(Stage::Fragment, text)}));
    EXPECT_EQ(toText({figures(Stage::Fragment, text)}),
              toText({Compiler(architectureNamed("navi21")).compile(pipelineOf({{Stage::Fragment, "test", text}})).back()}));
}

TEST_F(Compiling, NamesAndCommentsChangeNothing) {
    const std::string text = fragment("float of = sin(x.x); // once\n x *= of;");
    const std::string renamed = fragment("float other = sin(x.x); // twice, or so\n\n x *= other;");
    EXPECT_EQ(toText({figures(Stage::Fragment, text)}), toText({figures(Stage::Fragment, renamed)}));
}

TEST_F(Compiling, AFragmentShaderAloneIsNotFoldedAway) {
    const auto varying = figures(Stage::Fragment, fragment("x = sin(x);"));
    const auto constant = figures(Stage::Fragment, fragment("x = sin(vec4(1, 2, 3, 4));"));
    EXPECT_GE(varying.of("Instructions"), constant.of("Instructions") + 4);
}

TEST_F(Compiling, AVertexShaderAloneWritesAllItsOutputs) {
    const auto of = [](const std::string& body) {
        return figures(Stage::Vertex, "#version 450 core\nlayout(location = 0) in vec4 p; layout(location = 0) out vec3 a;\n"
                                      "layout(location = 1) flat out ivec2 b; layout(location = 3) out float c;\n"
                                      "void main() { gl_Position = p; a = p.xyz; b = ivec2(1); c = p.w; " +
                                          body + "}\n");
    };
    EXPECT_GE(of("a = sin(p.xyz); b = ivec2(p.xy * 3);").of("Instructions"), of("").of("Instructions") + 5);
}

TEST_F(Compiling, WidthOfWavesAndVersionsAreKnown) {
    const std::string text = fragment("x = sqrt(x);");
    EXPECT_EQ(figures(Stage::Fragment, text, "vega10").of("Subgroup size"), 64U);
    EXPECT_NE(compilerVersion().find("Mesa"), std::string::npos);
    EXPECT_NE(compilerVersion().find("glslang"), std::string::npos);
}

TEST(Architectures, AnUnknownOneIsRefusedWithNearMatches) {
    try {
        (void)architectureNamed("navi12");
        FAIL();
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("navi10"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace shadowbench::gpu
