// The paired-time rule against figures of its tests that can be counted by hand, then its error rates on simulated restarts.
#include "gate/paired.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <random>

namespace shadowbench::gate {
namespace {

std::vector<double> oneTo(int n) {
    std::vector<double> values(static_cast<std::size_t>(n));
    std::iota(values.rbegin(), values.rend(), 1.0); // in descending order: the rule must not rely on any
    return values;
}

TEST(MedianLowerBound, IsTheSignTestsOrderStatistic) {
    // P(Bin(10, ½) ≤ 1) = 11/1024, P(≤ 2) = 56/1024.
    EXPECT_EQ(medianLowerBound(oneTo(10), 11.0 / 1024 + 1e-9), 2);
    EXPECT_EQ(medianLowerBound(oneTo(10), 11.0 / 1024 - 1e-9), 1);
    EXPECT_EQ(medianLowerBound(oneTo(10), 0.05), 2);
    EXPECT_EQ(medianLowerBound(oneTo(10), 0.055), 3);
}

TEST(MedianLowerBound, IsNothingForTooFewSamples) {
    EXPECT_EQ(medianLowerBound(oneTo(4), 0.05), -std::numeric_limits<double>::infinity()); // 2⁻⁴ > 0.05
    EXPECT_EQ(medianLowerBound({}, 0.5), -std::numeric_limits<double>::infinity());
}

TEST(HodgesLehmann, IsTheMedianOfTheMeansOfPairs) {
    EXPECT_DOUBLE_EQ(hodgesLehmann({6, 1, 2}), 2.75); // of 1, 1.5, 2, 3.5, 4 and 6
    EXPECT_DOUBLE_EQ(hodgesLehmann({-3}), -3);
}

/// The same times in every restart; the base's and the control's lie 0.02 apart.
std::vector<RestartTimes> constant(double head, std::size_t count) {
    return std::vector<RestartTimes>(count, {-0.01, head, 0.01});
}

TEST(QuadeTail, IsTheShareOfThePlacesThatTheHeadCouldHaveHad) {
    EXPECT_DOUBLE_EQ(quadeTail(constant(0.05, 3), 0), 1.0 / 27); // last of three, three times
    EXPECT_DOUBLE_EQ(quadeTail(constant(0, 3), 0), 17.0 / 27);   // in the middle: half of the rest lies above
    EXPECT_DOUBLE_EQ(quadeTail(constant(-0.05, 3), 0), 1);
    EXPECT_DOUBLE_EQ(quadeTail(constant(0.05, 3), 0.05), 17.0 / 27);
    EXPECT_DOUBLE_EQ(quadeTail({}, 0), 1);
}

TEST(QuadeTail, ARestartCountsByTheRankOfItsRange) {
    // Sums of ±1 or 0 and ±2 or 0: of nine, four are at least 2 − 1 and six at least 1 − 2.
    EXPECT_NEAR(quadeTail({{0, -1, -0.5}, {0, 2, 1}}, 0), 4.0 / 9, 1e-12);
    EXPECT_NEAR(quadeTail({{0, 1, 0.5}, {0, -2, -1}}, 0), 7.0 / 9, 1e-12);
    EXPECT_NEAR(quadeTail({{0, 1, 0.5}, {0, -1, -0.5}}, 0), 6.0 / 9, 1e-12) << "equal ranges share their rank";
}

TEST(QuadeTail, EqualTimesAreNoOrder) {
    EXPECT_DOUBLE_EQ(quadeTail({{0, 1, 0}}, 0), 1.0 / 3);
    EXPECT_DOUBLE_EQ(quadeTail({{0, 0, -1}}, 0), 2.0 / 3);
    EXPECT_DOUBLE_EQ(quadeTail({{0, 0, 0}}, 0), 1);
}

TEST(SlowdownLowerBound, IsWhereTheTailRefusesNoMore) {
    const std::vector<RestartTimes> restarts = constant(0.05, 12);
    const double bound = slowdownLowerBound(restarts, 1e-4);
    EXPECT_NEAR(bound, 0.04, 1e-9); // where the control is as slow
    EXPECT_LE(quadeTail(restarts, bound - 1e-6), 1e-4);
    EXPECT_GT(quadeTail(restarts, bound + 1e-6), 1e-4);
    EXPECT_EQ(slowdownLowerBound(constant(0.05, 4), 0.01), -std::numeric_limits<double>::infinity()); // 3⁻⁴ > 0.01
    EXPECT_EQ(slowdownLowerBound({}, 0.5), -std::numeric_limits<double>::infinity());
}

TEST(SmallestTold, IsWhatNeitherPassesByChanceNorStaysUnclear) {
    const TimeRule rule;
    // Slowdowns −0.01 and 0.01 in turns: their deviation is 0.01 √(4/3) of four, 0.01 √(n/(n − 1)) of n.
    const auto inTurns = [](int count) {
        std::vector<RestartTimes> restarts;
        for (int i = 0; i < count; ++i) restarts.push_back({0, i % 2 == 0 ? -0.01 : 0.01, 0});
        return restarts;
    };
    const double afterFour = 1.644854 * 0.01 * std::sqrt(4.0 / 3) / 2; // passing at the first chance
    EXPECT_NEAR(smallestTold(inTurns(4), rule, 0.01, 96), std::expm1(std::log(1.01) + afterFour), 1e-6);
    const double atLast = (2.326348 + 1.644854) * 0.01 * std::sqrt(96.0 / 95) / std::sqrt(96); // α and 95 %
    EXPECT_NEAR(smallestTold(inTurns(96), rule, 0.01, 96), std::expm1(std::log(1.01) + atLast), 1e-6);
    EXPECT_GT(smallestTold(inTurns(96), rule, 1e-5, 96), smallestTold(inTurns(96), rule, 0.01, 96));
    EXPECT_NEAR(smallestTold(constant(0, 4), rule, 0.01, 96), rule.floor, 1e-9) << "without noise, the floor";
}

TEST(TimeRule, AConstantSlowdownIsJudgedByTheFloor) {
    const TimeRule rule;
    const auto judge = [&](double ratio, std::size_t restarts) {
        return judgeTime(std::vector<RestartTimes>(restarts, {0, std::log(ratio), 0}), rule, 200, 4);
    };
    EXPECT_EQ(judge(1.02, 12), TimeVerdict::Slower);
    EXPECT_EQ(judge(1.009, 12), TimeVerdict::Pass);
    EXPECT_EQ(judge(0.9, 12), TimeVerdict::Pass);
    EXPECT_EQ(judge(1.5, 10), TimeVerdict::Unclear); // 3⁻¹⁰ > 0.01/200/4
    EXPECT_EQ(judge(1.5, 11), TimeVerdict::Slower);
    EXPECT_EQ(judgeTime({}, rule, 1, 1), TimeVerdict::Unclear);
}

TEST(TimeRule, TheControlAlarmsInBothDirections) {
    const TimeRule rule;
    EXPECT_TRUE(controlAlarms(std::vector<double>(100, 0.05), rule, 200));
    EXPECT_TRUE(controlAlarms(std::vector<double>(100, -0.05), rule, 200));
    EXPECT_FALSE(controlAlarms(std::vector<double>(100, 0.005), rule, 200));
}

/// Times as they were seen on a shared machine: most processes run alike, one in ten is placed badly.
std::vector<RestartTimes> restarts(std::mt19937& random, double slowdown, std::size_t count) {
    std::normal_distribution<double> well(0, 0.015), badly(0, 0.1);
    std::bernoulli_distribution isBad(0.1);
    const auto process = [&] { return isBad(random) ? badly(random) : well(random); };
    std::vector<RestartTimes> times(count);
    for (RestartTimes& t : times) t = {process(), process() + std::log1p(slowdown), process()};
    return times;
}

int alarms(double slowdown, std::size_t count, int cells, int trials) {
    std::mt19937 random(7);
    int alarmed = 0;
    for (int i = 0; i < trials; ++i)
        if (judgeTime(restarts(random, slowdown, count), {}, cells, 4) == TimeVerdict::Slower) ++alarmed;
    return alarmed;
}

TEST(TimeRule, HasNoFalseAlarmInTwoThousandSimulatedCells) { EXPECT_EQ(alarms(0, 24, 200, 2000), 0); }

TEST(TimeRule, AlarmsNoMoreOftenThanAllowedAtTheFloorItself) {
    // α = 1 % at one cell and four looks: 10 of 4000 expected, and 22 or more in one of a thousand such tests.
    const int count = alarms(0.01, 12, 1, 4000);
    EXPECT_LT(count, 22);
    EXPECT_GT(count, 0) << "a rule that never alarms is no test";
}

TEST(TimeRule, FindsNineteenOfTwentySimulatedSlowdownsOfFivePerCent) { EXPECT_GE(alarms(0.05, 48, 200, 1000), 950); }

} // namespace
} // namespace shadowbench::gate
