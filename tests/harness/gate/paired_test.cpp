// The paired-time rule against the binomial distribution's own figures, then its error rates on simulated frames.
#include "harness/gate/paired.h"

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

TEST(TimeRule, AConstantSlowdownIsJudgedByTheFloor) {
    const TimeRule rule;
    EXPECT_EQ(judgeTime(std::vector<double>(100, std::log(1.02)), rule, 200, 1), TimeVerdict::Slower);
    EXPECT_EQ(judgeTime(std::vector<double>(100, std::log(1.009)), rule, 200, 1), TimeVerdict::Pass);
    EXPECT_EQ(judgeTime(std::vector<double>(100, std::log(0.9)), rule, 200, 1), TimeVerdict::Pass);
    EXPECT_EQ(judgeTime(std::vector<double>(10, std::log(1.5)), rule, 200, 1), TimeVerdict::Unclear); // 2⁻¹⁰ > 0.01/200
}

TEST(TimeRule, ACellPassesEarlyOnlyByItsUpperBound) {
    const TimeRule rule;
    EXPECT_TRUE(surelyNotSlower(std::vector<double>(20, std::log(1.009)), rule));
    EXPECT_FALSE(surelyNotSlower(std::vector<double>(20, std::log(1.011)), rule));
    EXPECT_FALSE(surelyNotSlower(std::vector<double>(6, 0), rule)); // 2⁻⁶ > 0.01: too few to be sure of anything
    // The upper bound of 20 rounds at 1 % is the fifth largest, P(Bin(20, ½) ≤ 4) = 0.0059: five slow rounds are too many.
    std::vector<double> ratios(20, 0);
    std::fill_n(ratios.begin(), 4, 0.1);
    EXPECT_TRUE(surelyNotSlower(ratios, rule));
    ratios[4] = 0.1;
    EXPECT_FALSE(surelyNotSlower(ratios, rule));
}

TEST(TimeRule, TheControlAlarmsInBothDirections) {
    const TimeRule rule;
    EXPECT_TRUE(controlAlarms(std::vector<double>(100, 0.05), rule, 200));
    EXPECT_TRUE(controlAlarms(std::vector<double>(100, -0.05), rule, 200));
    EXPECT_FALSE(controlAlarms(std::vector<double>(100, 0.005), rule, 200));
}

/// Log-ratios of paired frames as they were seen on a shared machine: a narrow middle, and one round in ten disturbed.
std::vector<double> rounds(std::mt19937& random, double slowdown, std::size_t count) {
    std::normal_distribution<double> calm(0, 0.02), disturbed(0, 0.2);
    std::bernoulli_distribution isDisturbed(0.1);
    std::vector<double> ratios(count);
    for (double& ratio : ratios) ratio = std::log1p(slowdown) + (isDisturbed(random) ? disturbed(random) : calm(random));
    return ratios;
}

int alarms(double slowdown, int trials) {
    std::mt19937 random(7);
    int count = 0;
    for (int i = 0; i < trials; ++i)
        if (judgeTime(rounds(random, slowdown, 100), {}, 200, 2) == TimeVerdict::Slower) ++count;
    return count;
}

TEST(TimeRule, HasNoFalseAlarmInTwoThousandSimulatedCells) { EXPECT_EQ(alarms(0, 2000), 0); }

TEST(TimeRule, FindsNineteenOfTwentySimulatedSlowdownsOfFivePerCent) { EXPECT_GE(alarms(0.05, 2000), 1900); }

} // namespace
} // namespace shadowbench::gate
