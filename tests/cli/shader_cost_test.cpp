// `shader-cost` as a user types it.
#include "tests/support/program.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

constexpr const char* blur =
    "#version 450 core\nin vec2 at;\nuniform sampler2D map;\nuniform float size;\nout vec4 colour;\n"
    "void main() {\n    colour = texture(map, at) * size; // BODY\n}\n";

class ShaderCostVerb : public testing::Test {
protected:
    void SetUp() override {
        const Outcome outcome = asked(folder_.write("probe.frag", blur));
        if (outcome.code == 5) GTEST_SKIP() << outcome.output;
        ASSERT_EQ(outcome.code, 0) << outcome.output;
    }

    [[nodiscard]] Outcome asked(const std::string& words, const std::string& out = "out") const {
        return shell("shadowbench shader-cost --quiet " + words + " --cache " + folder_ / "cache" + " --out " +
                     folder_ / out);
    }

    [[nodiscard]] std::string text(const std::string& out) const {
        std::ifstream file(folder_ / out + "/shader-cost.jsonl");
        return {std::istreambuf_iterator<char>(file), {}};
    }

    [[nodiscard]] std::vector<nlohmann::json> lines(const std::string& out = "out") const {
        std::vector<nlohmann::json> all;
        std::ifstream file(folder_ / out + "/shader-cost.jsonl");
        for (std::string line; std::getline(file, line);) all.push_back(nlohmann::json::parse(line));
        return all;
    }

    /// The shader of `blur` with another line, under the same name.
    [[nodiscard]] std::string changed(const std::string& line) const {
        std::string all = blur;
        return folder_.write("blur.frag", all.replace(all.find("// BODY"), 7, line));
    }

    Folder folder_;
};

TEST_F(ShaderCostVerb, AFileHasFiguresOnAllArchitectures) {
    const Outcome outcome = asked(folder_ / "probe.frag");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.starts_with("vega10/navi10/navi21/gfx1100; radv Mesa ")) << outcome.output;
    const auto all = lines();
    ASSERT_EQ(all.size(), 4U) << "the vertex shader that it is given is not the user's";
    for (const auto& line : all) {
        EXPECT_EQ(line["stage"], "fragment");
        for (const char* statistic :
             {"Instructions", "VGPRs", "SGPRs", "Subgroups per SIMD", "Latency", "Inverse Throughput", "Code size",
              "Branches", "Spilled VGPRs", "LDS size", "Scratch size", "VMEM Clause"})
            EXPECT_TRUE(line["statistics"].contains(statistic)) << statistic;
        EXPECT_GT(line["statistics"]["Instructions"], 5);
    }
    EXPECT_NE(all[0]["statistics"]["Code size"], all[3]["statistics"]["Code size"]) << "GCN 5 and RDNA 3";
}

TEST_F(ShaderCostVerb, FilesOfOneNameAreOneProgram) {
    const std::string vertex =
        folder_.write("probe.vert", "#version 450 core\nlayout(location = 0) in vec4 p;\nout vec2 other;\nout vec2 at;\n"
                                    "void main() { gl_Position = p; at = p.xy; other = p.zw; }\n");
    const Outcome outcome = asked(vertex + " " + folder_ / "probe.frag" + " --arch navi21");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto all = lines();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0]["stage"], "vertex");
    EXPECT_EQ(all[1]["stage"], "fragment");
}

TEST_F(ShaderCostVerb, TheSameTwiceAndFromTheCache) {
    ASSERT_EQ(asked("--technique sm-uniform", "first").code, 0);
    ASSERT_EQ(asked("--technique sm-uniform", "kept").code, 0);
    std::filesystem::remove_all(folder_ / "cache");
    ASSERT_EQ(asked("--technique sm-uniform", "again").code, 0);
    EXPECT_FALSE(text("first").empty());
    EXPECT_EQ(text("kept"), text("first"));
    EXPECT_EQ(text("again"), text("first"));
}

TEST_F(ShaderCostVerb, ATechniqueHasItsPasses) {
    ASSERT_EQ(asked("--technique sm-uniform --arch navi21 --arch vega10").code, 0);
    std::vector<std::string> shaders, clears;
    for (const auto& line : lines()) {
        EXPECT_EQ(line["technique"], "sm-uniform");
        EXPECT_EQ(line["scene"], "simple");
        if (line.contains("move")) {
            EXPECT_EQ(line["move"], "clear");
            clears.push_back(line["pass"].get<std::string>() + " " + line["format"].get<std::string>());
            continue;
        }
        EXPECT_GE(line["draws"], 1);
        if (line["architecture"] == "navi21")
            shaders.push_back(line["pass"].get<std::string>() + " " + line["stage"].get<std::string>() + " " +
                              line["source"].get<std::string>());
    }
    const std::vector<std::string> expected{"G-buffer vertex gl/gbuffer.vert",
                                            "G-buffer fragment gl/gbuffer.frag",
                                            "depth map vertex shared/maps/depth_map.vert",
                                            "depth map fragment gl/depth_only.frag",
                                            "resolve vertex gl/screen.vert",
                                            "resolve fragment shared/maps/single_map.frag"};
    EXPECT_EQ(shaders, expected);
    EXPECT_EQ(std::ranges::count(clears, "depth map Depth32F"), 1) << "once for all architectures";
}

TEST_F(ShaderCostVerb, ABaseTellsOneInstructionAndNoComment) {
    ASSERT_EQ(asked(changed(""), "before").code, 0);
    const std::string base = " --base " + folder_ / "before/shader-cost.jsonl";
    const Outcome same = asked(changed("/* brighter in the middle */") + base);
    EXPECT_EQ(same.code, 0);
    EXPECT_TRUE(same.output.starts_with("no change in 4 shaders\n")) << same.output;
    const Outcome slower = asked(changed("colour.x = min(colour.x, size * 0.25);") + base);
    EXPECT_EQ(slower.code, 0);
    EXPECT_NE(slower.output.find("navi21: total Instructions "), std::string::npos) << slower.output;
    EXPECT_NE(slower.output.find("helped 0, hurt 1"), std::string::npos) << slower.output;
    EXPECT_NE(slower.output.find("navi21: fragment " + folder_ / "blur.frag" + ": "), std::string::npos) << slower.output;
}

TEST_F(ShaderCostVerb, ABaseOfMoreTechniquesIsComparedInThoseThatAreChosen) {
    ASSERT_EQ(asked("--technique sm-uniform --technique pcf --arch navi21", "before").code, 0);
    const Outcome outcome = asked("--technique sm-uniform --arch navi21 --base " + folder_ / "before/shader-cost.jsonl");
    EXPECT_TRUE(outcome.output.starts_with("no change in 6 shaders\n")) << outcome.output;
}

TEST_F(ShaderCostVerb, WhatIsExecutedIsTheSameWhicheverPlatformDrawsInSoftware) {
    for (const std::string gl : {"osmesa", "egl"}) {
        const Outcome outcome =
            shell("LIBGL_ALWAYS_SOFTWARE=1 shadowbench shader-cost --quiet --technique pcss --arch navi21 --gl " + gl +
                  " --cache " + folder_ / ("cache-" + gl) + " --out " + folder_ / gl);
        ASSERT_EQ(outcome.code, 0) << outcome.output;
    }
    EXPECT_NE(text("egl").find("\"executed\""), std::string::npos);
    EXPECT_EQ(text("egl"), text("osmesa"));
}

TEST_F(ShaderCostVerb, WhatIsNoShaderIsRefusedWithARemedy) {
    const Outcome broken = asked(changed("colour = sharp;"));
    EXPECT_EQ(broken.code, 2);
    EXPECT_NE(broken.output.find("blur.frag:7: 'sharp' : undeclared identifier"), std::string::npos) << broken.output;
    EXPECT_EQ(asked(folder_ / "missing.frag").code, 2);
    const Outcome other = asked(folder_.write("notes.txt", "x"));
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.output.find(".vert, .frag or .comp"), std::string::npos) << other.output;
    EXPECT_EQ(asked(folder_.write("cut.spv", "SPIR-V")).code, 2);
    EXPECT_EQ(asked(folder_ / "probe.frag" + " --technique pcf").code, 2);
    EXPECT_EQ(asked(folder_ / "probe.frag" + " --arch navi99").code, 2);
    EXPECT_EQ(asked(folder_ / "probe.frag" + " --base " + folder_ / "probe.frag").code, 2);
    const Outcome none = asked("--technique 'lod-*' --scene eye-in-shadow");
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.output.find("is not applicable"), std::string::npos) << none.output;
}

TEST(ShaderCostWithoutADriver, IsInconclusiveAndNamesThePackage) {
    const Folder folder;
    const Outcome outcome =
        shell("SHADOWBENCH_LIBVULKAN_RADEON=nothing.so shadowbench shader-cost --technique sm-uniform --out " +
              folder / "out" + " --cache " + folder / "cache");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_NE(outcome.output.find("apt-get install mesa-vulkan-drivers"), std::string::npos) << outcome.output;
}

} // namespace
} // namespace shadowbench
