// Where series change: closed cases first, then error rates on series whose truth is known.
#include "base/random.h"
#include "harness/history/change_points.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace shadowbench::history {
namespace {

using Positions = std::vector<std::size_t>;

TEST(LevelChanges, CountWhenTheyAreLargerThanTheAllowanceOfTheOldLevel) {
    EXPECT_EQ(levelChanges({5, 5, 5}, {1, 1, 1}), Positions{});
    EXPECT_EQ(levelChanges({5, 6, 5}, {1, 1, 1}), Positions{}); // by as much as the allowance: none
    EXPECT_EQ(levelChanges({5, 6.5, 6.5}, {1, 1, 1}), Positions{1});
    EXPECT_EQ(levelChanges({5, 3.5, 5}, {1, 1, 1}), (Positions{1, 2})); // there and back
    EXPECT_EQ(levelChanges({5, 6.5, 5.2}, {1, 3, 1}), Positions{1});    // the new level allows more
    EXPECT_EQ(levelChanges({0, 0, 1e-9}, {0, 0, 0}), Positions{2});
    EXPECT_EQ(levelChanges({7}, {0}), Positions{});
    EXPECT_EQ(levelChanges({}, {}), Positions{});
}

TEST(LevelChanges, ADriftIsFoundOnceItsStepsSumUp) {
    EXPECT_EQ(levelChanges({0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4}, {1, 1, 1, 1, 1, 1, 1}), (Positions{3, 6}));
}

TEST(EnergyStatistic, ByHand) {
    // Two and two figures a distance 1 apart: Ê = 2·1 − 0 − 0 and Q = 2·2/4 Ê.
    EXPECT_DOUBLE_EQ(energyStatistic({0, 0, 1, 1}, 2), 2);
    // Across: (1 + 3 + 1 + 1)/4, within: 2 and 2.
    EXPECT_DOUBLE_EQ(energyStatistic({0, 2, 1, 3}, 2), 2 * 1.5 - 2 - 2);
    // Two against three: across 6·4/6, within 0 and (1 + 1 + 0)/3; Q = 6/5 (8 − 2/3), where 4 is the mean distance.
    EXPECT_NEAR(energyStatistic({0, 0, 4, 4, 4}, 2), 6.0 / 5 * 8, 1e-12);
    EXPECT_NEAR(energyStatistic({0, 0, 4, 4, 5}, 2), 6.0 / 5 * (2 * 13.0 / 3 - 2.0 / 3), 1e-12);
}

/// 0, 1, 2 …: every figure is of a commit of its own.
Positions single(std::size_t n) {
    Positions groups(n);
    std::iota(groups.begin(), groups.end(), 0);
    return groups;
}

/// `n` draws, those from `step` on moved by `shift`.
std::vector<double> series(std::size_t n, std::size_t step, double shift, Random& random,
                           const std::function<double(Random&)>& draw) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(draw(random) + (i < step ? 0 : shift));
    return values;
}

double normal(Random& random) { // Box and Muller
    return std::sqrt(-2 * std::log(1 - random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
}
double cauchy(Random& random) { return std::tan(std::numbers::pi * (random.uniform() - 0.5)); }
double coin(Random& random) { return random.uniform() < 0.3 ? 1 : 0; }

TEST(DistributionChanges, AClearStepIsFoundWhereItIs) {
    Random random(1);
    const std::vector<double> values = series(24, 9, 20, random, normal);
    EXPECT_EQ(distributionChanges(values, single(24), {}), Positions{9});
    EXPECT_EQ(distributionChanges(values, single(24), {}), distributionChanges(values, single(24), {})); // same seed
}

TEST(DistributionChanges, TwoStepsAreFound) {
    Random random(2);
    std::vector<double> values = series(36, 12, 20, random, normal);
    for (std::size_t i = 24; i < 36; ++i) values[i] += 20;
    EXPECT_EQ(distributionChanges(values, single(36), {}), (Positions{12, 24}));
}

TEST(DistributionChanges, FiguresOfOneCommitAreNeverSplit) {
    Random random(3);
    const std::vector<double> values = series(24, 10, 20, random, normal);
    Positions groups;
    for (std::size_t i = 0; i < 24; ++i) groups.push_back(i / 4); // the step lies within commit 2: figures 8 to 11
    for (const std::size_t change : distributionChanges(values, groups, {})) EXPECT_EQ(change % 4, 0U);
    EXPECT_EQ(distributionChanges(values, Positions(24, 0), {}), Positions{}); // all of one commit
}

TEST(DistributionChanges, FewOrEqualFiguresShowNothing) {
    EXPECT_EQ(distributionChanges({}, {}, {}), Positions{});
    EXPECT_EQ(distributionChanges({1, 1, 1, 9, 9}, single(5), {}), Positions{});    // no place for three on either side
    EXPECT_EQ(distributionChanges({1, 1, 1, 9, 9, 9}, single(6), {}), Positions{}); // 2 of the 20 orders are as far apart
    EXPECT_EQ(distributionChanges(std::vector<double>(30, 4.2), single(30), {}), Positions{});
}

/// In how many of 1,000 series of 20 figures anything is found.
int found(std::size_t step, double shift, double alpha, const std::function<double(Random&)>& draw) {
    NoiseRule rule;
    rule.alpha = alpha;
    Random random(77);
    int count = 0;
    for (int i = 0; i < 1000; ++i) {
        rule.seed = static_cast<std::uint64_t>(i);
        if (!distributionChanges(series(20, step, shift, random, draw), single(20), rule).empty()) ++count;
    }
    return count;
}

TEST(DistributionChanges, FalseAlarmsAreNoMoreThanStatedWhateverTheNoise) {
    // A permutation test is exact. Of 1,000 series 5 % are 50; more than 72 come once in a thousand times.
    EXPECT_LE(found(20, 0, 0.05, normal), 72);
    EXPECT_LE(found(20, 0, 0.05, cauchy), 72);
    EXPECT_LE(found(20, 0, 0.05, coin), 72);
    // 1 % are 10; more than 21 come once in a thousand times.
    EXPECT_LE(found(20, 0, 0.01, normal), 21);
}

TEST(DistributionChanges, StepsOfThreeStandardDeviationsAreFound) {
    // Two sample means of ten lie 3 / √(2/10) = 6.7 standard errors apart: no test at 1 % should miss one in a hundred.
    EXPECT_GE(found(10, 3, 0.01, normal), 990);
    // Four figures after the step: 5.4 standard errors. A t-test with 18 degrees of freedom that shares the 1 % among the 15
    // places where a step may be finds 862 of 1,000; the rest is four times the deviation of such a count, 11.
    EXPECT_GE(found(16, 3, 0.01, normal), 820);
}

} // namespace
} // namespace shadowbench::history
