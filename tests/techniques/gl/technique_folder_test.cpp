// What technique folders draw: the same bits as the technique that is built in, and means over frames in closed form.
#include "techniques/folder/inputs.h"
#include "techniques/gl/context.h"
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/sampling/sampling.h"
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
    const std::string kernel = "[parameter.kernel]\ndefault = 3\nrange = [3, 7]\nmeaning = \"taps\"\n";
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const WrittenTechnique folder(replaced(mapToml, "[target", kernel + "[target"), filteringShader);
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

/// Of a box over a slab, both closed, seen from above: how many faces lie one over the other.
float layersAt(const std::string& more, const char* value) {
    const std::string layers = "[target.layers]\nformat = \"R32F\"\nsize = 64\n\n[[pass]]\nname = \"layers\"\ndraw = "
                               "\"casters\"\nfragment = \"layers.frag\"\nto = \"layers\"\n" +
                               more + "\n";
    std::string toml = replaced(mapToml, "[[pass]]\nname = \"resolve\"", layers + "[[pass]]\nname = \"resolve\"");
    toml = "id = \"mine\"\n" + replaced(toml, "id = \"mine\"\n", "");
    const WrittenTechnique folder(toml, "uniform sampler2D layers;\nout float visibility;\nvoid main() { visibility = "
                                        "texelFetch(layers, ivec2(31, 31), 0).r / 16.0; }\n");
    folder.write("layers.frag",
                 fmt::format("in float casterDepth;\nout float layer;\nvoid main() {{ layer = {}; }}\n", value));
    Scene scene = boxScene(32);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    Stage stage(scene);
    stage.show(0);
    const auto technique = folder.made();
    return 16 * drawn(stage, *technique)(5, 5);
}

TEST(FolderTechnique, CastersAreBlendedWithoutADepthTestAndCulled) {
    const std::string all = "depth_test = false\nblend = \"add\"";
    EXPECT_EQ(layersAt("", "1.0"), 1);
    EXPECT_GT(layersAt("blend = \"add\"\nclear = [5, 0, 0, 0]", "1.0"), 5);
    const float both = layersAt(all, "1.0"), front = layersAt(all + "\ncull = \"back\"", "1.0"),
                back = layersAt(all + "\ncull = \"front\"", "1.0");
    EXPECT_EQ(both, front + back);
    EXPECT_EQ(front, back); // closed
    EXPECT_GE(front, 1);
    EXPECT_EQ(layersAt("depth_test = false\nblend = \"multiply\"\nclear = [3, 0, 0, 0]", "2.0"), 3 * std::exp2(both));
    // The nearest of all and the farthest: what the depth test keeps, and the floor's lower face.
    const float nearest = layersAt("depth_test = false\nblend = \"min\"\nclear = [9, 0, 0, 0]", "casterDepth");
    const float farthest = layersAt("depth_test = false\nblend = \"max\"", "casterDepth");
    EXPECT_EQ(nearest, layersAt("", "casterDepth"));
    EXPECT_GT(farthest, nearest);
    EXPECT_EQ(farthest, layersAt("depth_test = false\nblend = \"max\"\ncull = \"front\"", "casterDepth"));
}

std::string roundsToml(const std::string& there, const std::string& back) {
    return "id = \"rounds\"\ntitle = \"t\"\nanswer = \"hard\"\n[parameter.rounds]\ndefault = 3\nrange = [1, 8]\nmeaning = "
           "\"m\"\n[target.a]\nformat = \"R32F\"\nsize = \"image\"\n[target.b]\nformat = \"R32F\"\nsize = \"image\"\n"
           "[[pass]]\nname = \"begin\"\ndraw = \"screen\"\nfragment = \"one.frag\"\nto = \"a\"\n"
           "[[pass]]\nname = \"there\"\ndraw = \"screen\"\nfragment = \"there.frag\"\nto = \"b\"\n" +
           there + "[[pass]]\nname = \"back\"\ndraw = \"screen\"\nfragment = \"back.frag\"\nto = \"a\"\n" + back +
           "[[pass]]\nname = \"resolve\"\ndraw = \"screen\"\nfragment = \"resolve.frag\"\nto = \"visibility\"\n";
}

/// `a` begins as 1; `there` doubles it and adds the repetition, `back` adds 0.25.
float valueAfter(const std::string& there, const std::string& back, const std::string& parameters = "") {
    const WrittenTechnique folder(roundsToml(there, back), "uniform sampler2D a;\nout float visibility;\nvoid main() { "
                                                           "visibility = texelFetch(a, ivec2(0), 0).r / 256.0; }\n");
    folder.write("one.frag", "out float v;\nvoid main() { v = 1.0; }\n");
    folder.write("there.frag", "uniform sampler2D a;\nuniform int repetition;\nout float v;\nvoid main() { v = 2.0 * "
                               "texelFetch(a, ivec2(0), 0).r + float(repetition); }\n");
    folder.write("back.frag",
                 "uniform sampler2D b;\nout float v;\nvoid main() { v = texelFetch(b, ivec2(0), 0).r + 0.25; }\n");
    const Scene scene = boxScene(32);
    Stage stage(scene);
    stage.show(0);
    const auto technique = folder.made(parameters);
    return 256 * drawn(stage, *technique)(5, 5);
}

TEST(FolderTechnique, PassesAreRepeatedAloneOrInTurns) {
    EXPECT_EQ(valueAfter("", ""), 2.25F);
    EXPECT_EQ(valueAfter("repeat = 2\n", ""), 3.25F); // of the same a, the second time with 1 more
    EXPECT_EQ(valueAfter("group = \"g\"\nrepeat = 2\n", "group = \"g\"\n"), 5.75F); // 2.25, then 4.5 + 1 + 0.25
    EXPECT_EQ(valueAfter("group = \"g\"\nrepeat = \"rounds\"\n", "group = \"g\"\n", "rounds=1"), 2.25F);
    EXPECT_EQ(valueAfter("group = \"g\"\nrepeat = \"rounds\"\n", "group = \"g\"\n"), 13.75F); // 3: 11.5 + 2 + 0.25
    EXPECT_EQ(valueAfter("", "blend = \"add\"\nrepeat = 4\n"), 10.0F);                        // 1 and four times 2.25
    EXPECT_EQ(valueAfter("", "blend = \"add\"\nclear = [0, 0, 0, 0]\nrepeat = 4\n"), 2.25F);  // cleared each time
}

/// What one shader writes into a target of `format`, as another one reads it at a pixel.
float readBack(const std::string& format, const std::string& write, const std::string& read,
               const std::string& parameters = "") {
    const WrittenTechnique folder(
        "id = \"two\"\ntitle = \"t\"\nanswer = \"hard\"\n[parameter.bits]\ndefault = \"R32F\"\nchoices = [\"R8\", "
        "\"R32F\"]\nmeaning = \"m\"\n[target.a]\nformat = \"" +
            format +
            "\"\nsize = \"image\"\n[[pass]]\nname = \"draw\"\ndraw = \"screen\"\nfragment = \"drawn.frag\"\nto = \"a\"\n"
            "[[pass]]\nname = \"resolve\"\ndraw = \"screen\"\nfragment = \"resolve.frag\"\nto = \"visibility\"\n",
        read);
    folder.write("drawn.frag", write);
    const Scene scene = boxScene(32);
    Stage stage(scene);
    stage.show(0);
    const auto technique = folder.made(parameters);
    return drawn(stage, *technique)(5, 5);
}

TEST(FolderTechnique, ATargetTakesItsFormatFromAParameter) {
    const std::string written = "out float v;\nvoid main() { v = 0.301; }\n";
    const std::string read =
        "uniform sampler2D a;\nout float visibility;\nvoid main() { visibility = texelFetch(a, ivec2(0), 0).r; }\n";
    EXPECT_EQ(readBack("bits", written, read), 0.301F);
    EXPECT_EQ(readBack("bits", written, read, "bits=R8"), 77 / 255.0F);
    EXPECT_EQ(readBack("R8", written, read, "bits=R32F"), 77 / 255.0F);
}

TEST(FolderTechnique, WholeNumbersWrapAround) {
    EXPECT_EQ(
        readBack("RG32UI", "out uvec2 v;\nvoid main() { v = uvec2(4294967295u, 7u); }\n",
                 "uniform usampler2D a;\nout float visibility;\nvoid main() { uvec2 v = texelFetch(a, ivec2(0), 0).rg; "
                 "visibility = float(v.r + v.g) / 8.0; }\n"),
        0.75F);
}

TEST(FolderTechnique, AShaderThatDoesNotCompileIsOneLineWithItsOwnPlace) {
    const auto errorOf = [](const std::string& shader) {
        const WrittenTechnique folder(mapToml, shader);
        const std::string error = test::messageOf<BadInput>([&] { folder.made(); });
        return error.starts_with(folder.path().string()) ? error.substr(folder.path().string().size()) : error;
    };
    testContext();
    EXPECT_EQ(errorOf(replaced(mapShader, "receiver.seen ?", "reciever.seen ?")),
              "/resolve.frag:8: error: `reciever' undeclared (did you mean \"receiver\" or \"Receiver\"?)");
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
    EXPECT_EQ(errorOf("float visibility;\nvoid main() { visibility = 1.0; }\n"),
              "/resolve.frag: the pass \"resolve\" writes visibility, and its shader writes 0 outputs: declare an `out` for "
              "each, in their order, and write it");
    EXPECT_EQ(errorOf("#version 450\nout float visibility;\nvoid main() { visibility = 1.0; }\n"),
              "/resolve.frag:1: error: leave #version out: shaders here are 4.50 core");
    EXPECT_EQ(errorOf("uniform sampler2DShadow depths;\nout float visibility;\nvoid main() { visibility = texture(depths, "
                      "vec2(0.5)); }\n"),
              "/resolve.frag:3: error: no matching function for call to `texture(sampler2DShadow, vec2)'");
    EXPECT_NE(errorOf("in float casterDpeth;\nout float visibility;\nvoid main() { visibility = casterDpeth; }\n")
                  .find("casters' shaders have casterDepth and casterPosition"),
              std::string::npos);
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
    for (const bool several : {false, true}) {
        std::string declared, used = "0.0";
        for (const techniques::FolderInput& input : techniques::folderInputs()) {
            if (!several && input.name == "sliceEnds") continue; // of cascades
            const bool array = input.type.ends_with("[]") || (several && input.of == techniques::InputOf::EachView);
            const std::string type(input.type.substr(0, input.type.find('['))), name(input.name);
            const std::string value = array ? name + "[0]" : name;
            declared += fmt::format("uniform {} {}{};\n", type, name, array ? "[1]" : "");
            if (type == "int" || type == "float") used += " + float(" + value + ")";
            if (type.starts_with("vec")) used += " + " + value + ".x";
            if (type == "mat4") used += " + " + value + "[0].x";
            if (type == "sampler2D") used += " + texture(" + value + ", vec2(0.5)).x";
            if (type == "usampler2D") used += " + float(texture(" + value + ", vec2(0.5)).x)";
        }
        const std::string view = several ? "view = \"cascades\"\ncascades = { count = 1 }\nanswer" : "answer";
        const WrittenTechnique folder(replaced(mapToml, "answer", view),
                                      declared + "out float visibility;\nvoid main() { visibility = " + used + "; }\n");
        const Scene scene = halfPlaneScene(32);
        Stage stage(scene);
        stage.show(0);
        const auto technique = folder.made();
        drawn(stage, *technique);
        EXPECT_TRUE(std::isfinite(stage.visibility()(1, 1)));
    }
}

/// A folder whose answer is one number, which the shader makes of `uniforms`.
float shown(const std::string& keys, const std::string& uniforms, const std::string& number,
            const std::string& parameters = "") {
    const WrittenTechnique folder(replaced(mapToml, "answer", keys + "\nanswer"),
                                  uniforms + "out float visibility;\nvoid main() { visibility = " + number + "; }\n");
    const Scene scene = halfPlaneScene(16);
    Stage stage(scene);
    stage.show(0);
    return drawn(stage, *folder.made(parameters))(8, 8);
}

TEST(FolderTechnique, SamplesWithThePatternsThatItNames) {
    const auto fourth = [](const std::string& keys) {
        return shown("pattern.points = { " + keys + " }", "uniform vec2 points[4];\n",
                     "0.5 + 0.5 * points[3].x + 0.0 * points[2].x");
    };
    const auto x = [](const std::vector<glm::vec2>& points) { return 0.5F + 0.5F * points[3].x; };
    EXPECT_FLOAT_EQ(fourth("kind = \"poisson-disk\""), x(techniques::poissonTaps(4, techniques::Region::Disk)));
    EXPECT_FLOAT_EQ(fourth("kind = \"poisson-light\""), x(techniques::poissonTaps(4, techniques::Region::Square)));
    EXPECT_FLOAT_EQ(fourth("kind = \"grid\""), x(techniques::gridTaps(2)));
    EXPECT_FLOAT_EQ(shown("pattern.points = { kind = \"gaussian\", sigma = 2 }", "uniform vec2 points[4];\n", "points[3].y"),
                    techniques::gaussianPairs(4, 2)[3].y);
}

TEST(FolderTechnique, HasAnElementOfEachUniformForEachOfSeveralViews) {
    EXPECT_FLOAT_EQ(
        shown("view = \"cube\"", "uniform vec2 nearAndFar[TILES];\n", "nearAndFar[TILES - 1].x / nearAndFar[TILES - 1].y"),
        0.01F);
    const std::string error =
        test::messageOf<BadInput>([] { shown("view = \"cube\"", "uniform vec2 nearAndFar;\n", "nearAndFar.x"); });
    EXPECT_TRUE(error.ends_with("resolve.frag:1: the uniform \"nearAndFar\" is vec2[], not vec2")) << error;
    const std::string cascades = "view = \"cascades\"\ncascades = { count = 3, fit = \"view\", lambda = 0 }";
    const float second = shown(cascades, "uniform vec4 sliceEnds[TILES];\n", "sliceEnds[1].x / sliceEnds[2].x");
    const Scene scene = halfPlaneScene(16);
    const techniques::DepthRange depths = techniques::visibleDepths(snapshot(scene, 0).bounds(), scene.camera, 1);
    EXPECT_NEAR(second, (depths.near + 2 * (depths.far - depths.near) / 3) / depths.far, 1e-5);
}

TEST(FolderTechnique, HasOneMapOfTheSceneInPlaceOfNoCascades) {
    const std::string none = "view = \"cascades\"\ncascades = { count = 0 }";
    const std::string span = "uniform vec2 mapSpan;\n", ratio = "mapSpan.x / (mapSpan.x + mapSpan.y)";
    EXPECT_EQ(shown(none, span, ratio), shown("", span, ratio));
    const std::string error =
        test::messageOf<BadInput>([&] { shown(none, "uniform vec4 sliceEnds[TILES];\n", "sliceEnds[0].x"); });
    EXPECT_TRUE(error.ends_with("is of cascades: say view = \"cascades\"")) << error;
}

TEST(FolderTechnique, HasThePassesAndTargetsOfItsChoiceAlone) {
    std::string toml = replaced(
        mapToml, "[target", "[parameter.kind]\ndefault = \"one\"\nchoices = [\"one\", \"two\"]\nmeaning = \"m\"\n[target");
    toml = replaced(toml, "[[pass]]", "[target.more]\nformat = \"RGBA32F\"\nsize = \"map\"\n\n[[pass]]");
    toml = replaced(toml, "[[pass]]\nname = \"resolve\"",
                    "[[pass]]\nname = \"more\"\ndraw = \"screen\"\nfragment = \"more.frag\"\nto = \"more\"\nwhen = "
                    "\"kind=two\"\n\n[[pass]]\nname = \"resolve\"");
    const WrittenTechnique folder(toml);
    folder.write("more.frag", "out vec4 colour;\nvoid main() { colour = vec4(1.0); }\n");
    const Scene scene = boxScene(16);
    Stage stage(scene);
    stage.show(0);
    const auto bytes = [&](const std::string& parameters) {
        const std::size_t before = gl::Context::current().tally().bytes;
        const auto technique = folder.made(parameters);
        drawn(stage, *technique);
        return gl::Context::current().tally().bytes - before;
    };
    EXPECT_EQ(bytes("kind=two,map=64") - bytes("map=64"), 64U * 64 * 16);
    folder.write("resolve.frag", "uniform sampler2D more;\nout float visibility;\nvoid main() { visibility = texture(more, "
                                 "vec2(0.5)).r; }\n");
    EXPECT_EQ(drawn(stage, *folder.made("kind=two"))(8, 8), 1.0F);
    EXPECT_NE(test::messageOf<BadInput>([&] {
                  folder.made();
              }).find("resolve.frag:1: the pass \"resolve\" reads more, which no pass writes with these parameters"),
              std::string::npos);
}

} // namespace
} // namespace shadowbench
