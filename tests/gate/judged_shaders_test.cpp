// What a change of a shader's figures comes to.
#include "gate/judged_shaders.h"
#include "gate/verdict.h"

#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

using shaders::ShaderCost;
using shaders::ShaderCosts;

ShaderCost shader(double executed = 1000, const std::string& variant = "pcss", const std::string& architecture = "navi21") {
    ShaderCost cost{};
    cost.technique = variant;
    cost.scene = "simple";
    cost.frame = "f";
    cost.pass = "resolve";
    cost.stage = gpu::Stage::Fragment;
    cost.source = "soft/pcss/pcss.frag";
    cost.architecture = architecture;
    cost.statistics = {{"Instructions", 726}, {"VGPRs", 48},     {"Subgroups per SIMD", 16}, {"Spilled VGPRs", 0},
                       {"Spilled SGPRs", 2},  {"Latency", 3000}, {"Inverse Throughput", 600}};
    cost.executed = gpu::Executed{executed, executed, 0, 0, 0, 0, 0};
    return cost;
}

ShaderCost with(ShaderCost cost, const std::string& statistic, std::uint64_t value) {
    for (auto& [name, figure] : cost.statistics)
        if (name == statistic) figure = value;
    return cost;
}

ShaderCosts costs(std::vector<ShaderCost> shaders) { return {"radv Mesa 1, glslang 1", std::move(shaders)}; }

/// The one change.
Change changeOf(const ShaderCost& base, const ShaderCost& head) {
    const ShaderJudgement judged = judgeShaders(costs({base}), costs({head}));
    EXPECT_EQ(judged.changes.size(), 1U);
    return judged.changes.at(0);
}

Direction judged(const ShaderCost& base, const ShaderCost& head) { return changeOf(base, head).direction; }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(JudgedShaders, HalfAPerCentOfExecutedCyclesIsWorseAndLessIsNot) {
    EXPECT_EQ(judged(shader(1000), shader(1000)), Direction::Same);
    EXPECT_EQ(judged(shader(1000), shader(1004.9)), Direction::Same);
    EXPECT_EQ(judged(shader(1000), shader(1005)), Direction::Worse);
    EXPECT_EQ(judged(shader(1005), shader(1000)), Direction::Better);
    EXPECT_EQ(judged(shader(1004.9), shader(1000)), Direction::Same);
    EXPECT_EQ(judged(shader(0), shader(1)), Direction::Worse);
}

TEST(JudgedShaders, AWaveFewerIsWorse) {
    EXPECT_EQ(judged(shader(), with(shader(), "Subgroups per SIMD", 15)), Direction::Worse);
    EXPECT_EQ(judged(shader(), with(shader(), "Subgroups per SIMD", 17)), Direction::Better);
    const Change both = changeOf(shader(1000), with(shader(900), "Subgroups per SIMD", 15));
    EXPECT_EQ(both.direction, Direction::Worse) << "whatever else is better";
    EXPECT_EQ(both.base, 16);
    EXPECT_EQ(both.head, 15);
}

TEST(JudgedShaders, ANewSpillIsWorseOfEachKindOfRegister) {
    EXPECT_EQ(judged(shader(), with(shader(), "Spilled VGPRs", 1)), Direction::Worse);
    EXPECT_EQ(judged(shader(), with(shader(), "Spilled SGPRs", 3)), Direction::Worse);
    EXPECT_EQ(judged(shader(), with(with(shader(), "Spilled SGPRs", 0), "Spilled VGPRs", 1)), Direction::Worse);
    EXPECT_EQ(judged(shader(), with(shader(), "Spilled SGPRs", 0)), Direction::Better);
}

TEST(JudgedShaders, OtherFiguresAloneDecideNothing) {
    for (const char* statistic : {"Instructions", "VGPRs", "Latency", "Inverse Throughput"})
        EXPECT_EQ(judged(shader(), with(shader(), statistic, 5000)), Direction::Same) << statistic;
}

TEST(JudgedShaders, WhatWasNotCountedInOneFrameIsJudgedByTheCompilersEstimate) {
    const ShaderCost slower = with(shader(500), "Inverse Throughput", 603);
    ShaderCost otherFrame = slower, otherScene = slower, uncounted = slower;
    otherFrame.frame = "g";
    otherScene.scene = "trees";
    uncounted.executed.reset();
    for (const ShaderCost& head : {otherFrame, otherScene, uncounted}) {
        const ShaderJudgement judged = judgeShaders(costs({shader()}), costs({head}));
        EXPECT_EQ(judged.changes.at(0).direction, Direction::Worse);
        EXPECT_TRUE(contains(judged.changes[0].sentence, "estimated cycles +0.50 %")) << judged.changes[0].sentence;
        ASSERT_EQ(judged.notes.size(), 1U);
        EXPECT_TRUE(contains(judged.notes[0], "executed cycles of 1 shaders were not counted in one frame"));
    }
    ShaderCost before = shader();
    before.executed.reset();
    EXPECT_TRUE(judgeShaders(costs({before}), costs({uncounted})).notes.empty()) << "a vertex shader never is";
}

TEST(JudgedShaders, LittleMoreOfRewrittenBranchesIsUnclearUnlessTheEstimateIsWorse) {
    ShaderCost before = shader(1000), after = shader(1029);
    before.marks = 4;
    after.marks = 4;
    EXPECT_EQ(judged(before, after), Direction::Worse) << "lanes part in the same branches";
    after.marks = 5;
    EXPECT_EQ(judged(before, after), Direction::Unclear);
    EXPECT_EQ(verdictOf({changeOf(before, after)}), ExitCode::Pass);
    EXPECT_EQ(judged(before, with(after, "Inverse Throughput", 602)), Direction::Unclear);
    EXPECT_EQ(judged(before, with(after, "Inverse Throughput", 603)), Direction::Worse);
    EXPECT_EQ(judged(before, with(after, "Spilled VGPRs", 1)), Direction::Worse);
    after.executed->cycles64 = 1030;
    EXPECT_EQ(judged(before, after), Direction::Worse) << "no rewrite moves it so far";
}

TEST(JudgedShaders, AreNamedWithTheirFiguresOnTheArchitectureThatIsWorst) {
    const Change change = [] {
        const ShaderJudgement judged = judgeShaders(
            costs({shader(1000), shader(1000, "pcss", "vega10"), shader(1000, "pcss", "navi10")}),
            costs({with(shader(1010), "Instructions", 731), shader(1020, "pcss", "vega10"), shader(900, "pcss", "navi10")}));
        EXPECT_EQ(judged.changes.size(), 1U);
        return judged.changes.at(0);
    }();
    EXPECT_EQ(change.direction, Direction::Worse);
    EXPECT_EQ(change.changeClass, Class::Shader);
    EXPECT_EQ(change.variant, "pcss");
    EXPECT_EQ(change.metric, "resolve fragment soft/pcss/pcss.frag");
    EXPECT_EQ(change.file, "soft/pcss/pcss.frag");
    EXPECT_EQ(change.head, 1020);
    EXPECT_EQ(change.sentence,
              "pcss resolve fragment soft/pcss/pcss.frag on vega10: executed cycles +2.00 %: instructions 726, VGPRs 48, "
              "waves 16, branches 0, spills 2, latency 3000, inverse throughput 600, executed 1000.0 → 1020.0; worse on "
              "navi21, vega10");
}

TEST(JudgedShaders, NewAndGoneOnesAreNotedOfVariantsThatBothHave) {
    ShaderCost blur = shader(), other = shader();
    blur.pass = "blur";
    blur.source = "blur.frag";
    other.technique = "vsm";
    const ShaderJudgement more = judgeShaders(costs({shader()}), costs({shader(), blur, other}));
    EXPECT_EQ(more.changes.size(), 1U);
    EXPECT_EQ(more.notes,
              std::vector<std::string>{"shaders that only the head has are compared with none: blur fragment blur.frag of "
                                       "pcss"});
    const ShaderJudgement fewer = judgeShaders(costs({shader(), blur, other}), costs({shader()}));
    EXPECT_EQ(fewer.notes,
              std::vector<std::string>{"shaders that only the base has are compared with none: blur fragment blur.frag of "
                                       "pcss"});
    EXPECT_TRUE(fewer.notCompared.empty());
}

TEST(JudgedShaders, ARenamedPassOrFileHidesNothing) {
    ShaderCost pass = shader(1100), file = shader(1100);
    pass.pass = "shade";
    file.source = "soft/pcss/shade.frag";
    EXPECT_EQ(judged(shader(), pass), Direction::Worse);
    EXPECT_EQ(judged(shader(), file), Direction::Worse);
}

TEST(JudgedShaders, OfAnotherCompilerAreNotCompared) {
    ShaderCosts head = costs({shader(2000)});
    head.compiler = "radv Mesa 2, glslang 1";
    const ShaderJudgement judged = judgeShaders(costs({shader()}), head);
    EXPECT_TRUE(judged.changes.empty());
    ASSERT_EQ(judged.notCompared.size(), 1U);
    EXPECT_TRUE(contains(judged.notCompared[0], "by radv Mesa 1, glslang 1, those of the head by radv Mesa 2"));
}

TEST(JudgedShaders, OneThatManyVariantsShareIsOneFinding) {
    std::vector<ShaderCost> before, after;
    for (const char* variant : {"pcss", "pcss:map=512", "pcss:map=256"}) {
        before.push_back(shader(1000, variant));
        after.push_back(shader(variant == std::string("pcss:map=512") ? 1100 : 1010, variant));
    }
    before.push_back(shader(1000, "pcss:map=64"));
    after.push_back(shader(1000, "pcss:map=64"));
    std::vector<Change> changes = judgeShaders(costs(before), costs(after)).changes;
    changes.push_back({"simple", "pcss", "accuracy.leak", Class::Leak, 0, 1, 0, Direction::Worse, "leaks"});
    changes.push_back({"simple", "vsm", "accuracy.leak", Class::Leak, 0, 1, 0, Direction::Worse, "leaks"});
    const std::vector<Change> grouped = oneAShader(changes);
    ASSERT_EQ(grouped.size(), 4U) << "two leaks, the shader that is worse, and where it is the same";
    const auto worse = std::ranges::find_if(grouped, [](const Change& change) {
        return change.changeClass == Class::Shader && change.direction == Direction::Worse;
    });
    ASSERT_NE(worse, grouped.end());
    EXPECT_EQ(worse->variant, "pcss:map=512") << "the worst";
    EXPECT_TRUE(worse->sentence.ends_with("; in 2 more variants: pcss, pcss:map=256")) << worse->sentence;
}

TEST(JudgedShaders, AreACost) {
    const Change change = changeOf(shader(), shader(1100));
    EXPECT_EQ(name(change.changeClass), "shader");
    EXPECT_EQ(verdictOf({change}), ExitCode::CostRegression);
}

TEST(JudgedShaders, OfOnePassDoNotHideThoseOfAnother) {
    Change resolve = changeOf(shader(), shader(1100)), blur = resolve;
    blur.metric = "blur fragment soft/pcss/pcss.frag";
    EXPECT_EQ(oneACause({resolve, blur}).size(), 2U);
}

} // namespace
} // namespace shadowbench::gate
