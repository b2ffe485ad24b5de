// What is joined of records and shaders, by cases that can be computed by hand, and how near a model is said to be.
#include "studies/gpu_cost/gpu_cost.h"

#include "base/error.h"
#include "studies/gpu_cost/pass_work.h"

#include <gtest/gtest.h>
#include <regex>

namespace shadowbench::gpucost {
namespace {

shaders::ShaderCost shader(const std::string& pass, gpu::Stage stage, std::uint64_t cycles, shaders::Output output) {
    shaders::ShaderCost cost{};
    cost.pass = pass;
    cost.stage = stage;
    cost.draws = 1;
    cost.statistics = {{"Inverse Throughput", cycles}};
    cost.output = std::move(output);
    return cost;
}

PassRecord counted(const std::string& name, std::uint64_t fragments, std::uint64_t vertices = 3, int runs = 1) {
    PassRecord pass;
    pass.name = name;
    pass.runs = runs;
    pass.fragments = fragments;
    pass.vertices = vertices;
    pass.draws = 1;
    return pass;
}

/// Counted on 100 × 100 and, with 4 times the fragments, on 200 × 200.
Record recordOf(PassRecord pass) {
    Record record;
    record.scene = "simple";
    record.variant = "vsm";
    record.width = record.height = 100;
    record.passes = {pass};
    pass.fragments *= 4;
    record.otherScreen = OtherScreen{200, 200, {pass}};
    return record;
}

/// Of a record's one pass on an image of `side` squared, whose shaders were drawn on 50 × 50.
gpu::PassWork workOf(const Record& record, Drawn drawn, int side = 100) {
    drawn.screen = {50, 50};
    return worksOf({&record}, drawn, {side, side}).at(0).work;
}

TEST(PassCounts, AreOnAStraightLineInTheNumberOfPixels) {
    const Record record = recordOf(counted("resolve", 10000));
    EXPECT_EQ(countsOn({&record}, {100, 100}).at(0).fragments, 10000U);
    EXPECT_EQ(countsOn({&record}, {200, 200}).at(0).fragments, 40000U);
    EXPECT_EQ(countsOn({&record}, {300, 100}).at(0).fragments, 30000U);
    EXPECT_EQ(countsOn({&record}, {300, 200}).at(0).fragments, 60000U);
    EXPECT_EQ(countsOn({&record}, {300, 200}).at(0).vertices, 3U);
}

TEST(PassCounts, OfOneSizeAloneSayNothingOfAnother) {
    Record record = recordOf(counted("resolve", 10000));
    record.otherScreen.reset();
    EXPECT_EQ(countsOn({&record}, {100, 100}).at(0).fragments, 10000U);
    EXPECT_THROW((void)countsOn({&record}, {200, 100}), BadInput);
}

TEST(PassCounts, FragmentsThatADeviceDoesNotCountAreThoseOfAnotherRecord) {
    const Record device = recordOf(counted("depth map", 0, 600)), software = recordOf(counted("depth map", 2500, 900));
    const PassRecord both = countsOn({&device, &software}, {200, 200}).at(0);
    EXPECT_EQ(both.fragments, 10000U);
    EXPECT_EQ(both.vertices, 600U);
    EXPECT_EQ(countsOn({&software, &device}, {200, 200}).at(0).vertices, 900U);
}

TEST(PassCounts, ARecordOfOneSizeLeavesOthersToTheNext) {
    Record one = recordOf(counted("resolve", 100));
    one.otherScreen.reset();
    const Record two = recordOf(counted("resolve", 10000));
    EXPECT_EQ(countsOn({&one, &two}, {200, 200}).at(0).fragments, 40000U);
}

TEST(PassCounts, OfAFrameInMotionGrowAsThoseOfTheStandingOneAndAsTargets) {
    using shaders::CountedFrame;
    Record record = recordOf(counted("resolve", 10000));
    const shaders::Output screen{{"R8"}, false, "", false, {{{50, 50}, 1}}},
        map{{}, false, "Depth32F", true, {{{64, 64}, 1}}};
    const Drawn drawn{{shader("resolve", gpu::Stage::Fragment, 1, screen), shader("mask", gpu::Stage::Fragment, 1, screen),
                       shader("depth map", gpu::Stage::Fragment, 1, map)},
                      {},
                      {50, 50}};
    EXPECT_TRUE(worksOf({&record}, drawn, {200, 200}, CountedFrame::InMotion).empty()) << "it draws as the standing one";
    record.motionPasses = {counted("depth map", 5000, 300, 64), counted("mask", 2500), counted("resolve", 20000)};
    const std::vector<NamedWork> works = worksOf({&record}, drawn, {200, 200}, CountedFrame::InMotion);
    ASSERT_EQ(works.size(), 3U);
    EXPECT_EQ(works[0].work.depthPixels, 5000) << "a map";
    EXPECT_EQ(works[1].work.output.at(0).pixels, 4 * 2500) << "of the motion alone, as large as the screen";
    EXPECT_EQ(works[2].work.output.at(0).pixels, 4 * 20000) << "as the standing frame's pass grows";
    EXPECT_TRUE(worksOf({&record}, drawn, {200, 200}, CountedFrame::First).empty());
}

TEST(PassWork, AFragmentIsWrittenToEachTarget) {
    const shaders::Output output{{"RGBA32F", "R8"}, false, "Depth32F", true, {{{50, 50}, 1}}};
    const gpu::PassWork work =
        workOf(recordOf(counted("G-buffer", 5000, 300)),
               {{shader("G-buffer", gpu::Stage::Vertex, 40, output), shader("G-buffer", gpu::Stage::Fragment, 64, output)},
                {},
                {}});
    ASSERT_EQ(work.shading.size(), 2U);
    EXPECT_EQ(work.shading[0].count, 300);
    EXPECT_EQ(work.shading[1].count, 5000);
    EXPECT_EQ(work.shading[1].cycles, 64);
    ASSERT_EQ(work.output.size(), 2U);
    EXPECT_EQ(work.output[0].bytes, 16);
    EXPECT_TRUE(work.output[0].fullFloats);
    EXPECT_EQ(work.output[1].bytes, 1);
    EXPECT_EQ(work.output[1].pixels, 5000);
    EXPECT_EQ(work.depthPixels, 5000);
    EXPECT_EQ(work.triangles, 100);
    EXPECT_EQ(work.passes, 1);
    EXPECT_EQ(work.dependents, 0);
}

TEST(PassWork, FragmentsAreSharedByDraws) {
    shaders::ShaderCost often = shader("resolve", gpu::Stage::Fragment, 10, {{"R8"}, false, "", false, {{{50, 50}, 3}}});
    often.draws = 3;
    const gpu::PassWork work =
        workOf(recordOf(counted("resolve", 8000)), {{often, shader("resolve", gpu::Stage::Fragment, 20, {})}, {}, {}});
    EXPECT_EQ(work.shading.at(0).count, 6000);
    EXPECT_EQ(work.shading.at(1).count, 2000);
    EXPECT_EQ(work.passes, 1);
    EXPECT_EQ(work.dependents, 2) << "three targets, the second and third of which read the one before";
}

TEST(PassWork, ADepthMapIsCoveredOnceWhereNoFragmentIsCounted) {
    const shaders::Output output{{}, false, "Depth32F", true, {{{1024, 1024}, 1}}};
    const gpu::PassWork work = workOf(recordOf(counted("depth map", 0, 600)),
                                      {{shader("depth map", gpu::Stage::Fragment, 2, output)},
                                       {{"", "", "depth map", gpu::MoveKind::Clear, "Depth32F", {{{1024, 1024}, 1}}}},
                                       {}});
    EXPECT_EQ(work.depthPixels, 2 * 1024 * 1024);
    EXPECT_TRUE(work.shading.empty());
}

TEST(PassWork, AStencilIsTestedAndWritesNoDepth) {
    const shaders::Output output{{}, false, "Depth32FStencil8", false, {{{50, 50}, 1}}};
    const gpu::PassWork work = workOf(recordOf(counted("stencil count", 70000, 600)),
                                      {{shader("stencil count", gpu::Stage::Fragment, 2, output)}, {}, {}});
    EXPECT_EQ(work.testedPixels, 70000);
    EXPECT_EQ(work.depthPixels, 0);
    EXPECT_TRUE(work.output.empty());
}

TEST(PassWork, WhatIsAsLargeAsTheScreenGrowsWithIt) {
    const Drawn drawn{{},
                      {{"", "", "resolve", gpu::MoveKind::Clear, "R32F", {{{50, 50}, 2}, {{64, 64}, 1}}},
                       {"", "", "resolve", gpu::MoveKind::ReadBack, "", {{{4, 4}, 3}}}},
                      {}};
    const gpu::PassWork work = workOf(recordOf(counted("resolve", 10000)), drawn, 200);
    EXPECT_EQ(work.output.at(0).pixels, 2 * 200 * 200 + 64 * 64);
    EXPECT_EQ(work.readBacks, 3);
}

TEST(PassWork, APassThatDrawsTheSameOnEverySizeHasNoTargetThatGrows) {
    const Drawn drawn{{}, {{"", "", "pyramid", gpu::MoveKind::Copy, "RG32F", {{{50, 50}, 1}, {{25, 25}, 1}}}}, {}};
    Record record = recordOf(counted("pyramid", 3125));
    EXPECT_EQ(workOf(record, drawn, 200).output.at(0).pixels, 200 * 200 + 25 * 25);
    record.otherScreen->passes[0].fragments = 3125;
    EXPECT_EQ(workOf(record, drawn, 200).output.at(0).pixels, 50 * 50 + 25 * 25);
    EXPECT_EQ(workOf(record, drawn, 200).dependents, 2);
}

TEST(PassWork, ADispatchHasItsInvocations) {
    const gpu::PassWork work =
        workOf(recordOf(counted("blur", 0, 0)),
               {{shader("blur", gpu::Stage::Compute, 90, {{}, false, "", false, {{{1024, 4}, 2}}})}, {}, {}});
    EXPECT_EQ(work.shading.at(0).count, 8192);
    EXPECT_EQ(work.shading.at(0).cycles, 90);
}

TEST(PassWork, WhatIsExecutedStandsInPlaceOfTheGuess) {
    shaders::ShaderCost cost = shader("resolve", gpu::Stage::Fragment, 64, {{"R8"}, false, "", false, {{{50, 50}, 1}}});
    cost.executed = gpu::Executed{30, 40, 300, 400, 2, 3, 5};
    const gpu::PassWork work = workOf(recordOf(counted("resolve", 10000)), {{cost}, {}, {}}, 200);
    ASSERT_EQ(work.shading.size(), 1U);
    EXPECT_EQ(work.shading[0].count, 40000);
    EXPECT_EQ(work.shading[0].cycles, 40);
    EXPECT_EQ(work.shading[0].cycles32, 30);
    EXPECT_EQ(work.shading[0].longest, 400);
    EXPECT_EQ(work.shading[0].longest32, 300);
    EXPECT_EQ(work.reads, 40000 * 2) << "of textures";
}

TEST(PassWork, ADispatchGrowsByThePowerOfItsTwoImages) {
    // Counted on 50 × 50 and on 200 × 200: twice the rounds, and as many times the invocations as pixels.
    shaders::ShaderCost cost = shader("lists", gpu::Stage::Compute, 90, {{}, false, "", false, {{{2560, 1}, 1}}});
    cost.executed = gpu::Executed{100, 120, 1000, 1200, 1, 0, 0};
    cost.larger = shaders::Larger{{{{40960, 1}, 1}}, {200, 240, 4000, 4800, 1, 0, 0}};
    const auto shadingOn = [&](int side) {
        return workOf(recordOf(counted("lists", 0, 0)), {{cost}, {}, {}}, side).shading.at(0);
    };
    EXPECT_DOUBLE_EQ(shadingOn(50).cycles32, 100);
    EXPECT_DOUBLE_EQ(shadingOn(200).cycles32, 200);
    EXPECT_DOUBLE_EQ(shadingOn(200).count, 40960);
    EXPECT_NEAR(shadingOn(800).cycles32, 400, 1e-9);
    EXPECT_NEAR(shadingOn(800).longest32, 16000, 1e-9);
    EXPECT_NEAR(shadingOn(800).count, 16 * 40960, 1e-6);
}

TEST(PassWork, WhatIsLessOnTheLargerImageStaysAsItIsThere) {
    shaders::ShaderCost cost = shader("lists", gpu::Stage::Compute, 90, {{}, false, "", false, {{{64, 1}, 1}}});
    cost.executed = gpu::Executed{100, 120, 1000, 1200, 1, 0, 0};
    cost.larger = shaders::Larger{{{{64, 1}, 1}}, {90, 120, 0, 0, 1, 0, 0}};
    const gpu::PassWork work = workOf(recordOf(counted("lists", 0, 0)), {{cost}, {}, {}}, 800);
    EXPECT_EQ(work.shading.at(0).cycles32, 90);
    EXPECT_EQ(work.shading.at(0).count, 64);
    EXPECT_EQ(work.shading.at(0).longest32, 0);
}

ModelledFrame frame(const std::string& variant, double seconds, std::optional<double> measured, bool waits = false) {
    ModelledFrame frame{"simple", variant, "h200", {1024, 1024}, {seconds, seconds / 2, 2 * seconds}, waits, {}, measured};
    frame.passes.push_back({"resolve", {.arithmetic = seconds, .waits = waits}, measured});
    return frame;
}

TEST(Nearness, IsOfRanksAndOfTheMedianErrorAfterOneConstant) {
    const std::vector<double> modelled{1, 2, 3, 4, 5}, measured{2, 4, 6, 4, 20};
    const double constant = fittedConstant(modelled, measured);
    EXPECT_EQ(constant, 2); // of 2, 2, 2, 1, 4
    const Nearness near = nearness(modelled, measured, constant);
    EXPECT_EQ(near.count, 5U);
    EXPECT_EQ(near.median, 1); // of 1, 1, 1, 2, 2
    EXPECT_EQ(nearness(modelled, measured, 1).median, 2);
    EXPECT_NEAR(near.spearman.value(), 0.82, 0.01);
}

TEST(GpuCostText, NamesWhatLimitsAndCallsItModelled) {
    const std::string text = tables({frame("pcf", 0.002, {}), frame("sm-tiled", 0.001, {}, true)});
    EXPECT_TRUE(text.starts_with("simple at 1024×1024 on NVIDIA H200, modelled\n")) << text;
    EXPECT_NE(text.find("2.000"), std::string::npos) << text;
    EXPECT_NE(text.find("resolve: arithmetic"), std::string::npos) << text;
    EXPECT_NE(text.find("waits for the program"), std::string::npos) << text;
    EXPECT_EQ(comparison({frame("pcf", 0.002, {})}), "");
}

TEST(GpuCostText, HasWhatWasMeasuredBesideWhatWasNot) {
    const std::string text = tables({frame("pcf", 0.002, {}), frame("vsm", 0.003, 3.5)});
    EXPECT_TRUE(std::regex_search(text, std::regex("limited by +measured ms"))) << text;
    EXPECT_TRUE(std::regex_search(text, std::regex("pcf .* –\n"))) << text;
    EXPECT_TRUE(std::regex_search(text, std::regex("vsm .* 3\\.500\n"))) << text;
}

TEST(GpuCostText, ComparesWhatDoesNotWait) {
    const std::string text =
        comparison({frame("a", 0.001, 2), frame("b", 0.002, 4), frame("c", 0.003, 6), frame("w", 0.001, 500, true)});
    EXPECT_NE(text.find("one constant for all frames: × 2.00"), std::string::npos) << text;
    EXPECT_NE(text.find("1.000"), std::string::npos) << text;
    EXPECT_TRUE(std::regex_search(text, std::regex("1024×1024 +3 +1 +1\\.000"))) << text;
    EXPECT_EQ(text.find("500"), std::string::npos) << text;
    EXPECT_NE(text.find("3 of 3 measured frames"), std::string::npos) << text;
    EXPECT_NE(comparison({frame("a", 0.001, 2), frame("b", 0.001, 2.1)}).find("1 of 2 measured frames"), std::string::npos);
}

TEST(GpuCostRecords, HaveWhatWasModelledOfTheirTechniqueAlone) {
    Record bare;
    bare.scene = "simple";
    bare.variant = "vsm"; // of one that counts no work
    std::vector<Record> records{bare, recordOf(counted("resolve", 10000)), recordOf(counted("resolve", 10000))};
    records[2].variant = "pcf";
    for (Record& record : records) record.modelled["h200@1x1"] = {}; // of before
    addTo(records, {frame("vsm", 0.002, 3), frame("pcf", 0.004, {})});
    EXPECT_TRUE(records[0].modelled.empty());
    ASSERT_EQ(records[1].modelled.size(), 1U);
    const ModelledCost& cost = records[1].modelled.at("h200@1024x1024");
    EXPECT_EQ(cost.milliseconds, 2);
    EXPECT_EQ(cost.least, 1);
    EXPECT_EQ(cost.most, 4);
    EXPECT_EQ(cost.passes.at(0).name, "resolve");
    EXPECT_EQ(cost.passes.at(0).arithmetic, 2);
    EXPECT_EQ(cost.passes.at(0).fixed, 0);
    EXPECT_EQ(records[2].modelled.at("h200@1024x1024").milliseconds, 4);
}

TEST(GpuCosts, RecordsThatCannotBeJoinedAreRefused) {
    EXPECT_THROW((void)gpuCosts({Record()}, {}), BadInput);
    Record paper = recordOf(counted("resolve", 1));
    paper.profile = "paper";
    EXPECT_THROW((void)gpuCosts({paper}, {}), BadInput);
    EXPECT_THROW((void)gpuCosts({paper}, {.cards = {"h20"}, .cache = {}}), BadInput);
}

} // namespace
} // namespace shadowbench::gpucost
