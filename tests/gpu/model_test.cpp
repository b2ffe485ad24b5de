// The model by cases that can be computed by hand, on a card of round rates.
#include "gpu/model.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench::gpu {
namespace {

Card roundCard() {
    Card card{"round", "Round"};
    const auto set = [&](Rate rate, double value) { card.rates.at(static_cast<std::size_t>(rate)) = value; };
    set(Rate::Arithmetic, 32e9);
    set(Rate::Clock, 1e9);
    set(Rate::Texture, 20e9);
    set(Rate::Output, 16e9);
    set(Rate::OutputBytes, 64e9);
    set(Rate::BlendedBytes, 16e9);
    set(Rate::Depth, 8e9);
    set(Rate::Tested, 80e9);
    set(Rate::Geometry, 1e9);
    set(Rate::Memory, 1e12);
    set(Rate::Draws, 1e6);
    set(Rate::Passes, 2e5);
    set(Rate::Dependents, 1e5);
    set(Rate::ReadBacks, 5e4);
    return card;
}

TEST(Model, ArithmeticIsWavesTimesCycles) {
    // 2^20 fragments are 2^14 waves of 320 cycles; 640 vertices are 10 waves of 32 cycles.
    const PassWork work{.shading = {{1048576, 320, 320}, {640, 32, 32}}};
    EXPECT_DOUBLE_EQ(termsOf(work, roundCard()).arithmetic, (16384 * 320 + 10 * 32) / 32e9);
}

TEST(Model, ACardRunsWavesOfItsOwnWidth) {
    const PassWork work{.shading = {{1048576, 320, 200}}};
    Card card = roundCard();
    EXPECT_DOUBLE_EQ(termsOf(work, card).arithmetic, 16384 * 200 / 32e9);
    card.lanes = 64;
    EXPECT_DOUBLE_EQ(termsOf(work, card).arithmetic, 16384 * 320 / 32e9);
}

TEST(Model, FewWavesTakeAsLongAsTheLongest) {
    // One wave of a million cycles keeps one SIMD of the card busy, for a millisecond.
    EXPECT_DOUBLE_EQ(termsOf({.shading = {{64, 5e5, 5e5, 2e6, 1e6}}}, roundCard()).arithmetic, 1e-3);
    Card wide = roundCard();
    wide.lanes = 64;
    EXPECT_DOUBLE_EQ(termsOf({.shading = {{64, 5e5, 5e5, 2e6, 1e6}}}, wide).arithmetic, 2e-3);
    EXPECT_DOUBLE_EQ(termsOf({.shading = {{64e6, 32, 32, 2e5, 1e5}}}, roundCard()).arithmetic, 1e-3)
        << "hidden by the others";
}

TEST(Model, AThinTargetCostsPixelsAWideOneBytes) {
    const auto output = [](Written written) { return termsOf({.output = {written}}, roundCard()).output; };
    EXPECT_DOUBLE_EQ(output({1e6, 1}), 1e6 / 16e9);
    EXPECT_DOUBLE_EQ(output({1e6, 4, true}), 1e6 / 16e9);
    EXPECT_DOUBLE_EQ(output({1e6, 16, true}), 16e6 / 64e9);
}

TEST(Model, BlendingIsSlowerOfFullFloatsAlone) {
    const auto output = [](Written written) { return termsOf({.output = {written}}, roundCard()).output; };
    EXPECT_DOUBLE_EQ(output({1e6, 4, true, true}), 4e6 / 16e9);
    EXPECT_DOUBLE_EQ(output({1e6, 8, false, true}), 8e6 / 64e9);
}

TEST(Model, TargetsAndDepthAddUpAndTheirBytesAreMemory) {
    const PassWork work{.output = {{1e6, 16}, {1e6, 4, true, true}}, .depthPixels = 4e6, .testedPixels = 8e6, .bytes = 1e6};
    const Terms terms = termsOf(work, roundCard());
    EXPECT_DOUBLE_EQ(terms.output, 16e6 / 64e9 + 4e6 / 16e9 + 4e6 / 8e9 + 8e6 / 80e9);
    EXPECT_DOUBLE_EQ(terms.memory, (16e6 + 2 * 4e6 + 1e6) / 1e12);
}

TEST(Model, APassTakesTheLargestTermAndTheFixedOne) {
    const PassWork work{
        .shading = {{64e6, 32, 32}}, .reads = 40e6, .triangles = 1.5e6, .draws = 3, .passes = 2, .dependents = 1};
    const Terms terms = termsOf(work, roundCard());
    EXPECT_DOUBLE_EQ(terms.arithmetic, 1e-3);
    EXPECT_DOUBLE_EQ(terms.texture, 2e-3);
    EXPECT_DOUBLE_EQ(terms.geometry, 1.5e-3);
    EXPECT_DOUBLE_EQ(terms.fixed, 3e-6 + 1e-5 + 1e-5);
    EXPECT_DOUBLE_EQ(terms.seconds(), 2.023e-3);
    EXPECT_EQ(terms.limit(), Term::Texture);
    EXPECT_EQ(name(terms.limit()), "texture");
}

TEST(Model, WhereThereIsLittleWorkTheFixedTermLimits) {
    EXPECT_EQ(termsOf({.reads = 1, .draws = 1}, roundCard()).limit(), Term::Fixed);
}

TEST(Model, WhatReadsBackWaitsForTheProgram) {
    const Terms terms = termsOf({.reads = 40e6, .readBacks = 1}, roundCard());
    EXPECT_EQ(terms.limit(), Term::Program);
    EXPECT_DOUBLE_EQ(terms.seconds(), 2e-3 + 2e-5);
}

TEST(Model, TheIntervalIsThatOfTheRateThatChangesMost) {
    const std::vector<PassWork> passes{{.reads = 40e6}, {.triangles = 1e6}}; // 2 ms of texture, 1 ms of geometry
    const FrameTime time = frameTime(passes, roundCard());
    EXPECT_DOUBLE_EQ(time.seconds, 3e-3);
    EXPECT_DOUBLE_EQ(time.least, 2e-3); // texture twice as fast
    EXPECT_DOUBLE_EQ(time.most, 5e-3);  // half as fast
}

TEST(Model, ATermThatIsHiddenWidensNothing) {
    const std::vector<PassWork> passes{{.reads = 40e6, .triangles = 1.9e6}}; // 2 ms, and 1.9 ms at the same time
    EXPECT_DOUBLE_EQ(frameTime(passes, roundCard()).least, 1.9e-3);
}

} // namespace
} // namespace shadowbench::gpu
