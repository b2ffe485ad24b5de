// What machine code executes, by code written here, whose blocks can be added up by hand.
#include "gpu/executed.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace shadowbench::gpu {
namespace {

const std::string nl = "\n";

/// `count` vector instructions, of two cycles each, that wait for nothing.
std::string work(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "\tv_add_f32_e32 v" + std::to_string(100 + i) + ", 1.0, v0 ; 06\n";
    return text;
}

std::string mark(unsigned k) {
    return "\tv_mov_b32_e32 v9, 0x5b00000" + std::to_string(k) + nl + "\tbuffer_store_dword v9, off, s[8:11], 0 glc\n";
}

std::vector<double> vectorCycles(const std::string& code, unsigned marks) {
    std::vector<double> cycles;
    for (const Busy& busy : busyOfMarks(codeBlocks(code), marks)) cycles.push_back(busy[Part::Vector]);
    return cycles;
}

TEST(MachineCode, BlocksEndAtLabelsAndJumps) {
    const auto blocks = codeBlocks("BB0:\n" + work(3) + "\ts_cbranch_execz BB2\n" + work(1) + "BB2:\n" + work(2) +
                                   "\ts_cbranch_scc1 BB0\n\ts_endpgm\n");
    ASSERT_GE(blocks.size(), 4U);
    EXPECT_EQ(blocks[0].busy[Part::Vector], 6);
    EXPECT_EQ(blocks[0].jump, Jump::Divergent);
    EXPECT_EQ(blocks[0].target, 2U);
    EXPECT_EQ(blocks[1].busy[Part::Vector], 2);
    EXPECT_EQ(blocks[2].jump, Jump::Uniform);
    EXPECT_EQ(blocks[2].target, 0U);
    EXPECT_EQ(blocks[3].jump, Jump::Always);
}

TEST(MachineCode, EachKindOfInstructionHasItsUnit) {
    const auto blocks =
        codeBlocks("BB0:\n\tv_exp_f32_e32 v1, v0\n\tv_mul_lo_u32 v2, v0, v0\n\ts_add_u32 s0, s0, 1\n"
                   "\timage_sample v3, v[4:5], s[16:23], s[12:15] dmask:0x1 dim:SQ_RSRC_IMG_2D\n"
                   "\tbuffer_load_dword v6, v7, s[4:7], 0 offen\n\tbuffer_atomic_or v6, v7, s[4:7], 0 offen\n");
    const Busy& busy = blocks.at(0).busy;
    EXPECT_EQ(busy[Part::Vector], 2 + 8);
    EXPECT_EQ(busy[Part::Complex], 8 + 8);
    EXPECT_EQ(busy[Part::Scalar], 1);
    EXPECT_EQ(busy[Part::TextureReads], 1);
    EXPECT_EQ(busy[Part::BufferReads], 1);
    EXPECT_EQ(busy[Part::Stores], 1);
}

TEST(MachineCode, MemoryIsWaitedForWhereItIsUsed) {
    const std::string read = "\timage_sample v3, v[4:5], s[16:23], s[12:15] dmask:0x1\n";
    const auto latency = [](const std::string& code) { return codeBlocks("BB0:\n" + code).at(0).busy[Part::Latency]; };
    EXPECT_LT(latency(read + work(10)), 50);
    EXPECT_GT(latency(read + work(10) + "\ts_waitcnt vmcnt(0)\n"), 320);
    EXPECT_LT(latency(read + read + "\ts_waitcnt vmcnt(0)\n"), 330) << "both are on their way";
    EXPECT_GT(latency(read + "\ts_waitcnt vmcnt(0)\n" + read + "\ts_waitcnt vmcnt(0)\n"), 640);
}

TEST(MachineCode, AJumpToNowhereIsRefused) { EXPECT_THROW((void)codeBlocks("BB0:\n\ts_branch BB7\n"), BadInput); }

TEST(MachineCode, MarksAreFoundByTheirWordsAndCostNothing) {
    const auto blocks = codeBlocks("BB0:\n" + work(1) + mark(3) + "\ts_mov_b32 s4, 0x5b000005\n\tv_mov_b32_e32 v8, s4\n" +
                                   "\tbuffer_store_dword v8, off, s[8:11], 0 offset:20 glc\n\tv_add_f32_e32 v9, v0, v0\n" +
                                   "\tbuffer_store_dword v9, off, s[8:11], 0\n");
    EXPECT_EQ(blocks.at(0).marks, (std::vector<unsigned>{3, 5}));
    EXPECT_EQ(blocks.at(0).busy[Part::Stores], 1) << "the last store is the shader's own";
}

/// main, then a loop: its test, its body with mark 1, then what follows it.
const std::string loop = "BB0:\n" + mark(0) + work(5) + "BB1:\n" + work(2) + "\ts_cbranch_scc1 BB4\nBB2:\n" + mark(1) +
                         work(7) + "\ts_branch BB1\nBB4:\n" + work(3) + "\ts_endpgm\n";

TEST(Executed, ALoopsTestRunsOnceMoreThanItsBody) {
    // Mark 0: 5 before, the test once, 3 behind. Mark 1: 7 and the test. A mark's own move of its word is one more.
    EXPECT_EQ(vectorCycles(loop, 2), (std::vector<double>{2 * (1 + 5 + 2 + 3), 2 * (1 + 7 + 2)}));
}

TEST(Executed, TheGuessIsEightRounds) {
    const auto blocks = codeBlocks(loop);
    EXPECT_EQ(guessedBusy(blocks)[Part::Vector], 2 * (6 + 8 * (2 + 8) + 3));
    EXPECT_EQ(loopCount(blocks), 1U);
}

TEST(Executed, WhatMarksShareIsDividedAmongTheirPlaces) {
    const std::string twice = "BB0:\n" + mark(0) + work(4) + "BB1:\n" + mark(1) + work(3) + "\ts_cbranch_scc1 BB1\nBB2:\n" +
                              mark(1) + work(5) + "\ts_cbranch_scc1 BB2\nBB3:\n" + work(1);
    EXPECT_EQ(vectorCycles(twice, 2), (std::vector<double>{2 * (1 + 4 + 1), (2 * (1 + 3) + 2 * (1 + 5)) / 2.0}));
}

TEST(Executed, AnUnrolledLoopBelongsToWhatIsAroundIt) {
    const std::string unrolled = "BB0:\n" + mark(0) + mark(1) + work(3) + mark(1) + work(3) + "\ts_endpgm\n";
    EXPECT_EQ(vectorCycles(unrolled, 2), (std::vector<double>{2 * (3 + 6), 0}));
}

TEST(Executed, WhatFollowsACondition) {
    const std::string condition =
        "BB0:\n" + mark(0) + work(2) + "\ts_cbranch_execz BB2\n" + mark(1) + work(9) + "BB2:\n" + work(4) + "\ts_endpgm\n";
    EXPECT_EQ(vectorCycles(condition, 2), (std::vector<double>{2 * (1 + 2 + 4), 2 * (1 + 9)}));
    EXPECT_EQ(guessedBusy(codeBlocks(condition))[Part::Vector], 2 * (3 + 0.75 * 10 + 4));
}

TEST(Executed, BothSidesOfAUniformConditionAreHalf) {
    const std::string sides = "BB0:\n" + work(1) + "\ts_cbranch_scc0 BB2\n" + work(4) + "\ts_branch BB3\nBB2:\n" + work(6) +
                              "BB3:\n" + work(1) + "\ts_endpgm\n";
    EXPECT_EQ(guessedWeights(codeBlocks(sides)), (std::vector<double>{1, 0.5, 0.5, 1, 1}));
}

TEST(Executed, ALoopWithoutAMarkRunsAsTheCompilerGuesses) {
    const std::string bare = "BB0:\n" + mark(0) + work(2) + "BB1:\n" + work(3) + "\ts_cbranch_scc1 BB1\nBB2:\n" + work(1);
    EXPECT_EQ(vectorCycles(bare, 1), std::vector<double>{2 * (1 + 2 + 8 * 3 + 1)});
}

TEST(Executed, TheCompilersFigureIsScaledByWhatIsExecuted) {
    StageFigures figures{Stage::Fragment, {{"Inverse Throughput", 300}, {"Latency", 1000}}};
    figures.waves = 1000; // so that nothing waits
    figures.guessed[Part::Vector] = 150;
    figures.guessed[Part::Latency] = 500;
    std::vector<Busy> marks(2);
    marks[0][Part::Vector] = 50;
    marks[1][Part::Vector] = 10;
    marks[1][Part::Latency] = 40;
    marks[1][Part::TextureReads] = 1;
    const WavePasses passes{{16, 32}, {2, 12}, {1, 10}, {1, 9}, {1, 10}};
    const Executed all = executed(figures, marks, passes);
    EXPECT_DOUBLE_EQ(all.cycles64, 2 * (50 + 10 * 10));
    EXPECT_DOUBLE_EQ(all.cycles32, 2 * (50 + 6 * 10));
    EXPECT_DOUBLE_EQ(all.longest64, 2 * 10 * 40);
    EXPECT_DOUBLE_EQ(all.textureReads, 2);
}

TEST(Executed, WithoutMarksItIsTheCompilersFigure) {
    StageFigures figures{Stage::Fragment, {{"Inverse Throughput", 317}, {"Latency", 999}}};
    figures.guessed[Part::Vector] = 123;
    figures.guessed[Part::TextureReads] = 4;
    const Executed all = executed(figures, {}, {});
    EXPECT_EQ(all.cycles32, 317);
    EXPECT_EQ(all.cycles64, 317);
    EXPECT_EQ(all.longest32, 999);
    EXPECT_EQ(all.textureReads, 4);
}

} // namespace
} // namespace shadowbench::gpu
