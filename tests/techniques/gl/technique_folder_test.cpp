// What technique folders draw: the same bits as the technique that is built in, and means over frames in closed form.
#include "techniques/folder/inputs.h"
#include "tests/support/message_of.h"
#include "tests/support/soft_scenes.h"
#include "tests/support/technique_folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

Image<float> drawn(Stage& stage, techniques::Technique& technique, int frames = 1) {
    for (int frame = 0; frame < frames; ++frame) stage.render(technique, frame, 1);
    return stage.visibility();
}

double largestDifference(const Image<float>& a, const Image<float>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(double(a[i]) - double(b[i])));
    return largest;
}

TEST(FolderTechnique, DrawsTheBitsOfTheUniformMap) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    for (const std::string parameters : {"", "map=64"}) {
        const auto mine = WrittenTechnique().made(parameters);
        const Image<float> image = drawn(stage, *mine);
        EXPECT_EQ(largestDifference(image, rendered(stage, "sm-uniform:" + parameters)), 0) << parameters;
    }
    const auto mine = WrittenTechnique().made();
    EXPECT_GT(largestDifference(drawn(stage, *mine), rendered(stage, "sm-focused")), 0);
    const auto focused = WrittenTechnique(replaced(mapToml, "answer", "view = \"focused\"\nanswer")).made();
    EXPECT_EQ(largestDifference(drawn(stage, *focused), rendered(stage, "sm-focused")), 0);
}

TEST(FolderTechnique, DrawsTheBitsOfPercentageCloserFiltering) {
    const std::string shader = R"(#include "shared/filters/pcf.glsl"
#include "shared/maps/tested_point.glsl"
uniform sampler2DShadow depths;
out float visibility;
void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = testedPoint(receiver);
    vec2 slope = receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at);
    visibility = receiver.seen ? percentageCloser(depths, point, slope, KERNEL) : 1.0;
}
)";
    const std::string kernel = "[parameter.kernel]\ndefault = 3\nrange = [3, 7]\nmeaning = \"taps\"\n";
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const WrittenTechnique folder(replaced(mapToml, "[target", kernel + "[target"), shader);
    for (const char* parameters : {"kernel=3", "kernel=7"}) {
        const auto mine = folder.made(parameters);
        const Image<float> image = drawn(stage, *mine);
        EXPECT_EQ(largestDifference(image, rendered(stage, std::string("pcf:") + parameters)), 0) << parameters;
    }
}

const std::string meanToml = R"(id = "mean"
title = "Mean over frames"
answer = "filtered"
history = true

[target.sum]
format = "RG32F"
size = "image"
history = true

[[pass]]
name = "add"
draw = "screen"
fragment = "add.frag"
to = "sum"

[[pass]]
name = "resolve"
draw = "screen"
fragment = "resolve.frag"
to = "visibility"
)";

TEST(FolderTechnique, ReadsTheTexelsOfTheFrameBefore) {
    const WrittenTechnique folder(meanToml, "uniform sampler2D sum;\nout float visibility;\nvoid main() { visibility = "
                                            "texelFetch(sum, ivec2(gl_FragCoord.xy), 0).r / 8.0; }\n");
    folder.write("add.frag",
                 "uniform sampler2D previous_sum;\nuniform int historyFrames;\nout vec2 total;\nvoid main() { total "
                 "= texelFetch(previous_sum, ivec2(gl_FragCoord.xy), 0).rg + vec2(historyFrames, 1.0); }\n");
    EXPECT_TRUE(folder.entry().temporal);
    const Scene scene = boxScene(32);
    Stage stage(scene);
    stage.show(0);
    const auto mean = folder.made();
    const Image<float> third = drawn(stage, *mean, 3);
    EXPECT_EQ(third(16, 16), 3.0F / 8); // 0 + 1 + 2
    mean->reset();
    const Image<float> second = drawn(stage, *mean, 2);
    EXPECT_EQ(second(3, 30), 1.0F / 8);
}

TEST(FolderTechnique, CastersWriteTheirDepthAndTheMapIsAveragedIntoItsMipmaps) {
    std::string toml = replaced(mapToml, "format = \"Depth32F\"", "format = \"R32F\"\nmipmaps = true\nfilter = \"linear\"");
    toml = replaced(toml, "compare = true\n", "");
    toml = replaced(toml, "to = \"depths\"\n", "to = \"depths\"\nfragment = \"depth.frag\"\nclear = [1, 1, 1, 1]\n");
    const WrittenTechnique folder(toml, "uniform sampler2D depths;\nout float visibility;\nvoid main() { visibility = "
                                        "textureLod(depths, vec2(0.5), LEVEL).r; }\n");
    folder.write("depth.frag", "in float casterDepth;\nout float depth;\nvoid main() { depth = casterDepth; }\n");
    const auto level = [&](const char* value) {
        folder.write("technique.toml", replaced(toml, "to = \"visibility\"",
                                                std::string("to = \"visibility\"\ndefine = { LEVEL = \"") + value + "\" }"));
        const Scene scene = halfPlaneScene(32);
        Stage stage(scene);
        stage.show(0);
        const auto technique = folder.made("map=64");
        return drawn(stage, *technique)(5, 5);
    };
    const float middle = level("0.0"), mean = level("6.0");
    EXPECT_GT(middle, 0.0F);
    EXPECT_LT(middle, 1.0F);
    EXPECT_NE(middle, mean); // of all texels
    EXPECT_GT(mean, 0.0F);
    EXPECT_LE(mean, 1.0F);
}

TEST(FolderTechnique, AShaderThatDoesNotCompileIsOneLineWithItsOwnPlace) {
    const auto errorOf = [](const std::string& shader) {
        const WrittenTechnique folder(mapToml, shader);
        const std::string error = test::messageOf<BadInput>([&] { folder.made(); });
        return error.starts_with(folder.path().string()) ? error.substr(folder.path().string().size()) : error;
    };
    testContext();
    EXPECT_EQ(errorOf(replaced(mapShader, "receiver.seen ?", "reciever.seen ?")),
              "/resolve.frag:8: error: `reciever' undeclared");
    EXPECT_EQ(
        errorOf("#include \"shared/nothing.glsl\"\nvoid main() {}\n"),
        "/resolve.frag:1: there is no shader \"shared/nothing.glsl\", neither in the folder nor among those that come with "
        "the program");
    EXPECT_EQ(errorOf("uniform float strength;\nout float visibility;\nvoid main() { visibility = strength; }\n"),
              "/resolve.frag:1: nothing sets the uniform \"strength\"; parameters are macros in capitals");
    EXPECT_EQ(errorOf("uniform float seed;\nout float visibility;\nvoid main() { visibility = seed; }\n"),
              "/resolve.frag:1: the uniform \"seed\" is int, not float");
    EXPECT_EQ(errorOf("uniform sampler2DShadow dephts;\nout float visibility;\nvoid main() { visibility = texture(dephts, "
                      "vec3(0.5)); }\n"),
              "/resolve.frag:1: nothing sets the uniform \"dephts\" (did you mean \"depths\"?); parameters are macros in "
              "capitals");
}

TEST(FolderTechnique, APassThatReadsWhatItWritesIsRefused) {
    const WrittenTechnique folder(meanToml, "out float visibility;\nvoid main() { visibility = 1.0; }\n");
    folder.write("add.frag", "uniform sampler2D sum;\nout vec2 total;\nvoid main() { total = texelFetch(sum, "
                             "ivec2(gl_FragCoord.xy), 0).rg; }\n");
    testContext();
    EXPECT_NE(test::messageOf<BadInput>([&] { folder.made(); }).find("the pass \"add\" reads sum, which it writes"),
              std::string::npos);
}

TEST(FolderTechnique, EveryInputCanBeDeclaredAsItsType) {
    std::string declared, used = "0.0";
    for (const techniques::FolderInput& input : techniques::folderInputs()) {
        declared += fmt::format("uniform {} {};\n", input.type, input.name);
        const std::string name(input.name);
        if (input.type == "int") used += " + float(" + name + ")";
        if (input.type.starts_with("vec")) used += " + " + name + ".x";
        if (input.type == "mat4") used += " + " + name + "[0].x";
        if (input.type == "sampler2D") used += " + texture(" + name + ", vec2(0.5)).x";
        if (input.type == "usampler2D") used += " + float(texture(" + name + ", vec2(0.5)).x)";
    }
    const WrittenTechnique folder(mapToml, declared + "out float visibility;\nvoid main() { visibility = " + used + "; }\n");
    const Scene scene = halfPlaneScene(32);
    Stage stage(scene);
    stage.show(0);
    const auto technique = folder.made();
    drawn(stage, *technique);
    EXPECT_TRUE(std::isfinite(stage.visibility()(1, 1)));
}

} // namespace
} // namespace shadowbench
