// Lines as they are written and read, and what changed from one list to another.
#include "base/error.h"
#include "studies/shader_cost/lines.h"

#include <gtest/gtest.h>

namespace shadowbench::shaders {
namespace {

ShaderCost shader(const std::string& pass, std::uint64_t instructions, std::uint64_t waves = 16) {
    ShaderCost cost{};
    cost.technique = "pcss:map=512";
    cost.scene = "simple";
    cost.pass = pass;
    cost.stage = gpu::Stage::Fragment;
    cost.source = "soft/pcss/pcss.frag";
    cost.draws = 1;
    cost.architecture = "navi21";
    cost.statistics = {{"Instructions", instructions}, {"Subgroups per SIMD", waves}};
    return cost;
}

ShaderCosts costs(std::vector<ShaderCost> shaders) { return {"radv Mesa 1, glslang 1", std::move(shaders)}; }

TEST(ShaderCostLines, AreReadAsTheyWereWritten) {
    ShaderCost second = shader("resolve", 700);
    second.number = 2;
    second.output = {{"RG32F", "R8"}, true, "Depth32F", true, {{{1024, 1024}, 3}}};
    second.executed = gpu::Executed{1.5, 2.25, 100, 200, 3, 4, 5};
    second.frame = "0123456789ab";
    second.marks = 7;
    second.larger = Larger{{{{64, 2}, 1}}, {6, 7, 8, 9, 10, 11, 12}};
    ShaderCosts written = costs({shader("resolve", 726), second});
    written.moves.push_back({"pcss:map=512", "simple", "blur", gpu::MoveKind::ReadBack, "", {{{16, 16}, 1}}});
    const ShaderCosts read = parseLines(toLines(written), "lines");
    EXPECT_EQ(toLines(read), toLines(written));
    EXPECT_EQ(read.compiler, written.compiler);
    EXPECT_FALSE(read.shaders.at(0).executed);
    EXPECT_EQ(read.shaders.at(1).frame, "0123456789ab");
    EXPECT_EQ(read.shaders.at(1).marks, 7U);
    EXPECT_EQ(read.shaders.at(1).executed->stores, 5);
    EXPECT_EQ(read.shaders.at(1).larger->executed.cycles32, 6);
    EXPECT_EQ(read.shaders.at(1).name(), "pcss:map=512 resolve fragment soft/pcss/pcss.frag #2");
}

TEST(ShaderCostLines, OneThatIsNoneIsRefusedByItsNumber) {
    try {
        (void)parseLines(toLines(costs({shader("resolve", 1)})) + "{\"technique\": 3}\n", "old.jsonl");
        FAIL();
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("line 2 of old.jsonl"), std::string::npos) << error.what();
    }
}

TEST(ShaderCostLines, AListOfPipelinesIsReadAsItWasWritten) {
    const Output output{{"RGBA16F"}, true, "Depth32F", true, {{{1024, 512}, 2}}};
    const FrameList list{
        {{"resolve", 3, "abc", {{gpu::Stage::Vertex, "a"}, {gpu::Stage::Fragment, "b"}}, output}},
        {{"", "", "resolve", gpu::MoveKind::Clear, "R32F", {{{256, 256}, 1}}}},
    };
    FrameList withCounts = list;
    withCounts.frame = "0123456789ab";
    withCounts.pipelines[0].passes = {{4, 9}, {2, 5}, {1, 3}, {1, 3}, {1, 3}};
    withCounts.pipelines[0].larger = {{{{64, 1}, 2}}, {{8, 9}, {4, 5}, {2, 3}, {1, 2}, {1, 2}}};
    EXPECT_EQ(toText(frameList(toText(withCounts))), toText(withCounts));
    EXPECT_EQ(frameList(toText(withCounts)).pipelines.at(0).passes.waves32, (std::vector<std::uint64_t>{2, 5}));
    EXPECT_EQ(toText(frameList(toText(list))), toText(list));
    EXPECT_EQ(frameList(toText(list)).pipelines.at(0).output.extents, output.extents);
    EXPECT_THROW((void)frameList("[{}]"), BadInput);
    EXPECT_THROW((void)frameList(""), BadInput);
}

TEST(ShaderCostLines, OlderOnesSayNothingOfTargets) {
    const ShaderCosts read =
        parseLines(R"({"technique":"a","scene":"s","pass":"p","stage":"fragment","source":"f","number":1,"draws":1,)"
                   R"("architecture":"navi21","compiler":"c","statistics":{"VGPRs":4}})",
                   "old.jsonl");
    EXPECT_TRUE(read.shaders.at(0).output.extents.empty());
    EXPECT_TRUE(read.moves.empty());
}

TEST(ShaderCostChanges, NothingIsSaidOfEqualShaders) {
    EXPECT_EQ(changes(costs({shader("resolve", 726)}), costs({shader("resolve", 726)})), "no change in 1 shaders\n");
}

TEST(ShaderCostChanges, NameTotalsThenShaders) {
    const ShaderCosts before = costs({shader("resolve", 726), shader("blur", 74)});
    const ShaderCosts after = costs({shader("resolve", 727), shader("blur", 74)});
    EXPECT_EQ(changes(before, after),
              "navi21: total Instructions 800 → 801 (+0.12 %); helped 0, hurt 1\n"
              "navi21: pcss:map=512 resolve fragment soft/pcss/pcss.frag: Instructions 726 → 727 (+0.14 %)\n");
}

TEST(ShaderCostChanges, FewerWavesAreWorse) {
    const std::string text = changes(costs({shader("resolve", 726, 16)}), costs({shader("resolve", 726, 12)}));
    EXPECT_NE(text.find("total Subgroups per SIMD 16 → 12 (-25.00 %); helped 0, hurt 1"), std::string::npos) << text;
}

TEST(ShaderCostChanges, ARenamedPassOrFileIsTheOnlyShaderThatIsLeft) {
    ShaderCost pass = shader("shade", 730), file = shader("resolve", 730), second = shader("again", 730);
    file.source = "soft/pcss/shade.frag";
    for (const ShaderCost& renamed : {pass, file}) {
        const std::string text = changes(costs({shader("resolve", 726)}), costs({renamed}));
        EXPECT_NE(text.find(": Instructions 726 → 730"), std::string::npos) << text;
        EXPECT_EQ(text.find("new: "), std::string::npos) << text;
    }
    const std::string two = changes(costs({shader("resolve", 726)}), costs({pass, second})); // which of the two is it?
    EXPECT_NE(two.find("gone: pcss:map=512 resolve"), std::string::npos) << two;
    EXPECT_EQ(two.find("726 → 730"), std::string::npos) << two;
}

TEST(ShaderCostChanges, ExecutedCyclesOfAnotherFrameAreNotCompared) {
    ShaderCost before = shader("resolve", 726), after = before;
    before.executed = gpu::Executed{1, 100, 0, 0, 0, 0, 0};
    after.executed = gpu::Executed{1, 200, 0, 0, 0, 0, 0};
    EXPECT_NE(changes(costs({before}), costs({after})).find("executed cycles 100 → 200"), std::string::npos);
    after.frame = "another";
    EXPECT_EQ(changes(costs({before}), costs({after})), "no change in 1 shaders\n");
}

TEST(ShaderCostChanges, NewAndGoneShadersAndAnotherCompilerAreNamed) {
    ShaderCost blur = shader("blur", 74);
    blur.source = "blur.frag";
    ShaderCosts after = costs({blur});
    after.compiler = "radv Mesa 2, glslang 1";
    EXPECT_EQ(changes(costs({shader("resolve", 726)}), after),
              "another compiler: radv Mesa 1, glslang 1 before, radv Mesa 2, glslang 1 after; all changes may be its own\n"
              "new: pcss:map=512 blur fragment blur.frag\n"
              "gone: pcss:map=512 resolve fragment soft/pcss/pcss.frag\n");
}

TEST(ShaderCostTable, HasOneFigureWhereArchitecturesAgree) {
    ShaderCost other = shader("resolve", 700, 16);
    other.architecture = "vega10";
    const std::string text = table(costs({shader("resolve", 726), other}));
    EXPECT_TRUE(text.starts_with("navi21/vega10; radv Mesa 1, glslang 1\n")) << text;
    EXPECT_NE(text.find(" 726/700 "), std::string::npos) << text;
    EXPECT_NE(text.find(" 16 "), std::string::npos) << text;
    EXPECT_EQ(text.find("16/16"), std::string::npos) << text;
}

TEST(ShaderCostTable, ShowsWhatIsExecutedWhereSomethingIsCounted) {
    EXPECT_EQ(table(costs({shader("resolve", 726)})).find("executed"), std::string::npos);
    ShaderCost counted = shader("resolve", 726);
    counted.executed = gpu::Executed{10, 1234.4, 0, 0, 0, 0, 0};
    const std::string text = table(costs({counted, shader("blur", 74)}));
    EXPECT_NE(text.find("executed"), std::string::npos) << text;
    EXPECT_NE(text.find(" 1234"), std::string::npos) << text;
    EXPECT_NE(text.find("–"), std::string::npos) << text;
}

TEST(ShaderCostChanges, WhatIsExecutedIsComparedToTheDigit) {
    ShaderCost before = shader("resolve", 726), after = before;
    before.executed = gpu::Executed{0, 1000, 0, 0, 0, 0, 0};
    after.executed = gpu::Executed{0, 1000.5, 0, 0, 0, 0, 0};
    const std::string text = changes(costs({before}), costs({after}));
    EXPECT_NE(text.find("total executed cycles 1000 → 1000.5 (+0.05 %); helped 0, hurt 1"), std::string::npos) << text;
    EXPECT_EQ(changes(costs({shader("resolve", 726)}), costs({after})), "no change in 1 shaders\n")
        << "an older list has none";
}

} // namespace
} // namespace shadowbench::shaders
