// Compute passes of technique folders: the bits of fragment shaders, each format, and the line of what is wrong.
#include "tests/support/message_of.h"
#include "tests/support/technique_folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench {
namespace {

/// A pass that draws over the screen or computes, as `how` says it.
std::string pass(const char* name, const std::string& how, const char* to) {
    return fmt::format("[[pass]]\nname = \"{}\"\n{}\nto = \"{}\"\n\n", name, how, to);
}

std::string target(const char* name, const std::string& keys) { return fmt::format("[target.{}]\n{}\n\n", name, keys); }

/// The map of `mapToml` with further targets and passes before the resolve pass.
std::string withPasses(const std::string& more) {
    const std::string toml = replaced(mapToml, "compare = true\n", ""), last = "[[pass]]\nname = \"resolve\"";
    return replaced(toml, last, more + last);
}

Image<float> drawn(const WrittenTechnique& folder, const std::string& parameters = "") {
    const Scene scene = boxScene(32);
    Stage stage(scene);
    stage.show(0);
    const auto technique = folder.made(parameters);
    stage.render(*technique, 0, 1);
    return stage.visibility();
}

/// A mean along x of seven texels of the map, as both kinds of shader include it.
const std::string meanOfRow = R"(uniform sampler2D depths;
vec2 meanAt(ivec2 at) {
    vec2 sum = vec2(0.0);
    for (int i = -3; i <= 3; ++i) {
        float depth = texelFetch(depths, clamp(at + ivec2(i, 0), ivec2(0), textureSize(depths, 0) - 1), 0).r;
        sum += vec2(depth, depth * depth);
    }
    return sum / 7.0;
}
)";
const std::string meanByFragments =
    "#include \"mean.glsl\"\nout vec2 mean;\nvoid main() { mean = meanAt(ivec2(gl_FragCoord.xy)); }\n";
const std::string meanByCompute = R"(#include "mean.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
writeonly uniform image2D means;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    imageStore(means, at, vec4(meanAt(at), 0.0, 0.0));
}
)";
const std::string showMeans = R"(#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"
uniform sampler2D means;
out float visibility;
void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    vec2 mean = texture(means, mapPoint(receiver.position).at.xy).rg;
    visibility = 0.5 * (mean.x + mean.y);
}
)";

std::unique_ptr<WrittenTechnique> meansFolder(const std::string& how,
                                              const std::string& keys = "format = \"RG32F\"\nsize = \"map\"") {
    auto folder =
        std::make_unique<WrittenTechnique>(withPasses(target("means", keys) + pass("blur", how, "means")), showMeans);
    folder->write("mean.glsl", meanOfRow);
    folder->write("mean.frag", meanByFragments);
    folder->write("mean.comp", meanByCompute);
    return folder;
}

TEST(FolderCompute, DrawsTheBitsOfAFragmentShaderAtAnySize) {
    const std::string draw = "draw = \"screen\"\nfragment = \"mean.frag\"", compute = "compute = \"mean.comp\"";
    for (const std::string keys :
         {"format = \"RG32F\"\nsize = \"map\"", "format = \"RG16F\"\nsize = \"map\"\nmipmaps = true",
          "format = \"RG32F\"\nsize = \"map\"\nfilter = \"linear\""})
        for (const char* parameters : {"map=64", "map=101"}) { // whole groups, and some that run past the end
            const Image<float> mine = drawn(*meansFolder(compute, keys), parameters),
                               theirs = drawn(*meansFolder(draw, keys), parameters);
            EXPECT_TRUE(std::ranges::equal(mine, theirs)) << keys << " " << parameters;
            EXPECT_NE(*std::ranges::min_element(mine), *std::ranges::max_element(mine));
        }
}

/// Sums along the rows of a target of ones, a group for each row, which hold a row together.
float lastSum(const std::string& groups, const std::string& parameters = "") {
    std::string more =
        target("ones", "format = \"R32F\"\nsize = \"map\"") + target("sums", "format = \"R32F\"\nsize = \"map\"");
    more += pass("ones", "draw = \"screen\"\nfragment = \"ones.frag\"", "ones");
    more += pass("sums", "compute = \"sums.comp\"\n" + groups, "sums");
    const WrittenTechnique folder(withPasses(more),
                                  "uniform sampler2D sums;\nout float visibility;\nvoid main() { ivec2 last = "
                                  "textureSize(sums, 0) - 1;\n visibility = texelFetch(sums, last, 0).r / "
                                  "1024.0; }\n");
    folder.write("ones.frag", "out float one;\nvoid main() { one = 1.0; }\n");
    folder.write("sums.comp", R"(layout(local_size_x = 32) in;
uniform sampler2D ones;
writeonly uniform image2D sums;
shared float part[32];
void main() {
    int row = int(gl_WorkGroupID.y), lane = int(gl_LocalInvocationID.x), width = textureSize(ones, 0).x, run = width / 32;
    part[lane] = 0.0;
    for (int i = 0; i < run; ++i) part[lane] += texelFetch(ones, ivec2(lane * run + i, row), 0).r;
    barrier();
    float sum = 0.0;
    for (int i = 0; i < lane; ++i) sum += part[i];
    for (int i = 0; i < run; ++i) {
        ivec2 at = ivec2(lane * run + i, row);
        sum += texelFetch(ones, at, 0).r;
        imageStore(sums, at, vec4(sum));
    }
}
)");
    return 1024 * drawn(folder, parameters)(5, 5);
}

TEST(FolderCompute, HasAsManyGroupsAsATargetHasTexelsOrANumberSays) {
    EXPECT_EQ(lastSum("work_groups = [1, \"sums\", 1]"), 1024);
    EXPECT_EQ(lastSum("work_groups = [1, \"ones\", 1]", "map=64"), 64);
    EXPECT_EQ(lastSum("work_groups = [1, 64, 1]", "map=64"), 64);
    EXPECT_NE(lastSum("work_groups = [1, 63, 1]", "map=64"), 64); // the last row is not summed
}

/// What a compute shader stores into a target, as a fragment shader reads it.
float readBack(const std::string& format, const std::string& store, const std::string& read) {
    const bool whole = format == "RG32UI";
    std::string toml = replaced(withPasses(target("a", "format = \"" + format + "\"\nsize = \"image\"") +
                                           pass("store", "compute = \"store.comp\"", "a")),
                                "[target.depths]",
                                "[parameter.bits]\ndefault = \"R32F\"\nchoices = [\"R8\", \"R32F\"]\nmeaning "
                                "= \"m\"\n\n[target.depths]");
    const WrittenTechnique folder(toml,
                                  fmt::format("uniform {}sampler2D a;\nout float visibility;\nvoid main() {{ visibility = "
                                              "{}; }}\n",
                                              whole ? "u" : "", read));
    folder.write(
        "store.comp",
        fmt::format("layout(local_size_x = 8, local_size_y = 4) in;\nwriteonly uniform {}image2D a;\nvoid main() {{ "
                    "imageStore(a, ivec2(gl_GlobalInvocationID.xy), {}); }}\n",
                    whole ? "u" : "", store));
    return drawn(folder)(5, 5);
}

TEST(FolderCompute, StoresIntoEachFormatButDepths) {
    const std::string read = "texelFetch(a, ivec2(31), 0).";
    for (const char* format : {"R32F", "RG32F", "RGBA32F", "bits"})
        EXPECT_EQ(readBack(format, "vec4(0.3)", read + "r"), 0.3F) << format;
    for (const char* format : {"RG16F", "RGBA16F", "R8", "RGBA8", "RGBA16"})
        EXPECT_EQ(readBack(format, "vec4(0.0, 1.0, 1.0, 1.0)", read + "r"), 0) << format;
    for (const char* format : {"RGBA16F", "RGBA8", "RGBA16"})
        EXPECT_EQ(readBack(format, "vec4(0.0, 0.0, 0.0, 1.0)", read + "a"), 1) << format;
    EXPECT_NEAR(readBack("RGBA16", "vec4(0.301)", read + "r"), 0.301, 1.0 / 65535);
    EXPECT_EQ(readBack("RG32UI", "uvec4(4294967295u, 7u, 0u, 0u)", "float(" + read + "r + " + read + "g) / 8.0"), 0.75F);
}

TEST(FolderCompute, TheLastPassMayStoreTheAnswer) {
    const std::string answer = "compute = \"answer.comp\"";
    const WrittenTechnique folder(replaced(mapToml, "draw = \"screen\"\nfragment = \"resolve.frag\"", answer));
    folder.write("answer.comp", R"(layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2DShadow depths;
uniform sampler2D positions;
writeonly uniform image2D visibility;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    imageStore(visibility, at, vec4(texelFetch(positions, at, 0).w * 0.25 + 0.0 * texture(depths, vec3(0.5))));
}
)");
    EXPECT_EQ(drawn(folder)(16, 16), 0.25F);
}

TEST(FolderCompute, WhatIsWrongIsOneLineWithItsPlace) {
    testContext();
    const auto errorOf = [](const std::string& shader, const std::string& groups = "") {
        const WrittenTechnique folder(
            withPasses(target("a", "format = \"RG32F\"\nsize = \"image\"") +
                       pass("blur", "compute = \"blur.comp\"\n" + groups, "a")),
            "uniform sampler2D a;\nout float visibility;\nvoid main() { visibility = texelFetch(a, "
            "ivec2(0), 0).r; }\n");
        folder.write("blur.comp", "layout(local_size_x = 8) in;\n" + shader);
        const std::string error = test::messageOf<BadInput>([&] { drawn(folder); });
        return error.starts_with(folder.path().string()) ? error.substr(folder.path().string().size()) : error;
    };
    const std::string store = "void main() { imageStore(a, ivec2(0), vec4(1.0)); }\n";
    EXPECT_EQ(errorOf("writeonly uniform image2D a;\nvoid main() { imageStroe(a, ivec2(0), vec4(1.0)); }\n").substr(0, 21),
              "/blur.comp:3: error: ");
    EXPECT_EQ(errorOf("void main() {}\n"),
              "/blur.comp: the pass \"blur\" writes a, but its shader stores into no such image: declare writeonly uniform "
              "image2D a;");
    EXPECT_EQ(errorOf("layout(rg32f) uniform image2D a;\n" + store),
              "/blur.comp:2: images are written alone: declare writeonly uniform image2D a;");
    EXPECT_EQ(errorOf("writeonly uniform uimage2D a;\nvoid main() { imageStore(a, ivec2(0), uvec4(1)); }\n"),
              "/blur.comp:2: the uniform \"a\" is image2D, not uimage2D");
    EXPECT_EQ(errorOf("writeonly uniform image2D aa;\nvoid main() { imageStore(aa, ivec2(0), vec4(1.0)); }\n"),
              "/blur.comp:2: the pass \"blur\" does not write aa (did you mean \"a\"?): name it in `to`");
    EXPECT_EQ(errorOf("writeonly uniform image2D a;\n" + store, "work_groups = [65535, 65535, 1]"),
              ": the pass \"blur\" would run 4294836225 work groups; 67108864 are allowed");
    EXPECT_EQ(errorOf("writeonly uniform image2D a;\n" + store, "work_groups = [1, 1, 1]"), "");
    const WrittenTechnique folder(mapToml,
                                  "writeonly uniform image2D depths;\nout float visibility;\nvoid main() { visibility = "
                                  "1.0; imageStore(depths, ivec2(0), vec4(1.0)); }\n");
    const std::string error = test::messageOf<BadInput>([&] { folder.made(); });
    EXPECT_TRUE(error.ends_with("/resolve.frag:1: images are stored into by compute passes alone: declare a sampler"))
        << error;
}

} // namespace
} // namespace shadowbench
