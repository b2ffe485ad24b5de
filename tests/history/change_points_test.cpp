// Where series change: closed cases first, then error rates on series whose truth is known.
#include "base/random.h"
#include "history/change_points.h"

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
    EXPECT_EQ(levelChanges({5, 5.9, 4.1}, {1, 1, 1}), Positions{2});    // near the old level, but not the commit before
    EXPECT_EQ(levelChanges({0, 0, 1e-9}, {0, 0, 0}), Positions{2});
    EXPECT_EQ(levelChanges({7}, {0}), Positions{});
    EXPECT_EQ(levelChanges({}, {}), Positions{});
}

TEST(LevelChanges, ADriftIsFoundOnceItsStepsSumUp) {
    EXPECT_EQ(levelChanges({0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4}, {1, 1, 1, 1, 1, 1, 1}), (Positions{3, 6}));
}

TEST(EnergyRatio, ByHand) {
    // Sums of distances over the figures of a stretch: 10/4 in all, 2/2 in either half; one degree of freedom and two.
    EXPECT_DOUBLE_EQ(energyRatio({0, 2, 1, 3}, {2}), (2.5 - 2) / 1 / (2.0 / 2));
    EXPECT_DOUBLE_EQ(energyRatio({0, 0, 4, 4, 5}, {2}), (28.0 / 5 - 2.0 / 3) / 1 / (2.0 / 3 / 3));
    EXPECT_DOUBLE_EQ(energyRatio({0, 2, 1, 3, 5, 7}, {2, 4}), (48.0 / 6 - 3) / 2 / (3.0 / 3));
    EXPECT_DOUBLE_EQ(energyRatio({0, 20, 10, 30}, {2}), 0.5) << "no unit";
    EXPECT_TRUE(std::isinf(energyRatio({0, 0, 1, 1}, {2})));
    EXPECT_EQ(energyRatio({1, 1, 1, 1}, {2}), 0);
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

/// Of one series alone.
Positions changesOf(const std::vector<double>& values, const Positions& commits) {
    return distributionChanges({{values, commits}}, {}).changes.front();
}

double normal(Random& random) { // Box and Muller
    return std::sqrt(-2 * std::log(1 - random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
}
double cauchy(Random& random) { return std::tan(std::numbers::pi * (random.uniform() - 0.5)); }
double coin(Random& random) { return random.uniform() < 0.3 ? 1 : 0; }

TEST(DistributionChanges, AClearStepIsFoundWhereItIs) {
    Random random(1);
    const std::vector<double> values = series(24, 9, 20, random, normal);
    EXPECT_EQ(changesOf(values, single(24)), Positions{9});
    EXPECT_EQ(changesOf(values, single(24)), changesOf(values, single(24))); // same seed
}

TEST(DistributionChanges, TwoStepsAreFound) {
    Random random(2);
    std::vector<double> values = series(36, 12, 20, random, normal);
    for (std::size_t i = 24; i < 36; ++i) values[i] += 20;
    EXPECT_EQ(changesOf(values, single(36)), (Positions{12, 24}));
}

TEST(DistributionChanges, OfEachPartAreFound) {
    for (const std::size_t finer : {0U, 12U, 24U}) { // by five deviations, within one of three levels that lie far apart
        Random random(6);
        std::vector<double> values = series(36, 12, 100, random, normal);
        for (std::size_t i = 24; i < 36; ++i) values[i] += 200;
        for (std::size_t i = finer; i < finer + 6; ++i) values[i] -= 5;
        Positions expected{12, 24, finer + 6};
        std::ranges::sort(expected);
        EXPECT_EQ(changesOf(values, single(36)), expected) << finer;
    }
}

TEST(DistributionChanges, FiguresOfOneCommitAreNeverSplit) {
    Random random(3);
    const std::vector<double> values = series(24, 10, 20, random, normal);
    Positions groups;
    for (std::size_t i = 0; i < 24; ++i) groups.push_back(i / 4); // the step lies within commit 2: figures 8 to 11
    for (const std::size_t change : changesOf(values, groups)) EXPECT_EQ(change % 4, 0U);
    EXPECT_EQ(changesOf(values, Positions(24, 0)), Positions{}); // all of one commit
}

TEST(DistributionChanges, FewOrEqualFiguresShowNothing) {
    EXPECT_EQ(changesOf({}, {}), Positions{});
    EXPECT_EQ(changesOf({1, 1, 1, 9, 9}, single(5)), Positions{});    // no place for three on either side
    EXPECT_EQ(changesOf({1, 1, 1, 9, 9, 9}, single(6)), Positions{}); // 2 of the 20 orders are as far apart
    EXPECT_EQ(changesOf(std::vector<double>(30, 4.2), single(30)), Positions{});
}

TEST(DistributionChanges, NoRatioIsWantedWhereNoFigureVaries) {
    NoiseRule rule;
    rule.orders = 19; // none may be as far apart
    const NoiseChanges found = distributionChanges({{std::vector<double>(9, 4.2), single(9)}}, rule);
    EXPECT_EQ(found.leastRatio, NoiseChanges().leastRatio);
}

/// In how many of 1,000 series of 20 figures anything is found.
int found(std::size_t step, double shift, double alpha, const std::function<double(Random&)>& draw) {
    NoiseRule rule;
    rule.falseDiscoveries = alpha;
    rule.orders = static_cast<int>(10 / alpha);
    Random random(77);
    int count = 0;
    for (int i = 0; i < 1000; ++i) {
        rule.seed = static_cast<std::uint64_t>(i);
        const Noisy one{series(20, step, shift, random, draw), single(20)};
        if (!distributionChanges({one}, rule).changes.front().empty()) ++count;
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

/// `count` series of `n` times with 1.5 % of noise.
std::vector<Noisy> times(std::size_t count, std::size_t n, Random& random) {
    const auto noise = [](Random& r) { return 0.015 * normal(r); };
    std::vector<Noisy> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back({series(n, n, 0, random, noise), single(n)});
    return all;
}

TEST(ManySeries, ADoubledTimeAmong300IsFoundAfterThreeCommits) {
    for (const std::size_t newest : {3U, 5U, 8U}) {
        Random random(4 + newest);
        std::vector<Noisy> all = times(300, 12 + newest, random);
        for (std::size_t i = 12; i < 12 + newest; ++i) all[123].values[i] += std::log(2.0);
        const auto changes = distributionChanges(all, {}).changes;
        EXPECT_EQ(changes[123], Positions{12}) << newest;
    }
}

TEST(ManySeries, ADoubledTimeThatIsHeldForThreeCommitsOf40IsFound) {
    Random random(5);
    std::vector<Noisy> all = times(300, 40, random);
    for (std::size_t i = 20; i < 23; ++i) all[123].values[i] += std::log(2.0);
    EXPECT_EQ(distributionChanges(all, {}).changes[123], (Positions{20, 23}));
}

/// Of 20 series of 20 figures, the first ones with a step of three standard deviations: how often anything is found in the
/// others, and the mean share of these among all that are found, in `repetitions`.
std::pair<int, double> falseOnes(std::size_t stepped, int repetitions) {
    Random random(6);
    int some = 0;
    double shares = 0;
    for (int i = 0; i < repetitions; ++i) {
        std::vector<Noisy> all;
        for (std::size_t k = 0; k < 20; ++k) {
            const auto draw = k % 4 == 3 ? cauchy : normal;
            const double unit = k % 2 == 0 ? 1 : 100;
            all.push_back({series(20, k < stepped ? 10 : 20, 3, random, draw), single(20)});
            for (double& value : all.back().values) value *= unit;
        }
        NoiseRule rule;
        rule.orders = 200; // for the time that it takes: enough to know 5 % of one to a tenth of it
        rule.seed = static_cast<std::uint64_t>(i);
        const auto changes = distributionChanges(all, rule).changes;
        const auto found = [&](std::size_t from, std::size_t end) {
            std::ptrdiff_t count = 0;
            for (std::size_t k = from; k < end; ++k) count += changes[k].empty() ? 0 : 1;
            return count;
        };
        const auto wrong = found(stepped, 20), all20 = found(0, 20);
        some += wrong > 0 ? 1 : 0;
        shares += wrong > 0 ? static_cast<double>(wrong) / static_cast<double>(all20) : 0;
    }
    return {some, shares / repetitions};
}

TEST(ManySeries, FalseDiscoveriesAreNoMoreThanStatedWhateverTheNoise) {
    // Where nothing changes any discovery is false: 5 % of 200 repetitions are 10; more than 21 come once in a thousand
    // times.
    EXPECT_LE(falseOnes(0, 200).first, 21);
    // 15 of 20 do not change: 5 % · 15/20. The share has a standard deviation of 0.08 at most (one in five or six, in a
    // fifth of the repetitions): three standard errors of 200 are 0.017.
    EXPECT_LE(falseOnes(5, 200).second, 0.0375 + 0.017);
}

TEST(SmallestRise, IsFoundAndALittleLessIsNot) {
    Random random(7);
    const std::vector<Noisy> all = times(50, 20, random);
    const NoiseChanges found = distributionChanges(all, {});
    const std::optional<double> rise = smallestRise(all[0], 0.01, found.leastRatio, {});
    ASSERT_TRUE(rise.has_value());
    // Three of twenty: a standard error of 1.5 % √(1/3 + 1/17). Among 50 series no test that is as rarely wrong sees less
    // than four of them, nor does a good one need ten.
    EXPECT_GT(*rise, 4 * 0.015 * std::sqrt(1.0 / 3 + 1.0 / 17));
    EXPECT_LT(*rise, 10 * 0.015 * std::sqrt(1.0 / 3 + 1.0 / 17));
    const auto changesWhen = [&](double by) {
        std::vector<Noisy> moved = all;
        for (std::size_t i = 17; i < 20; ++i) moved[0].values[i] += by;
        return distributionChanges(moved, {}).changes[0];
    };
    EXPECT_EQ(changesWhen(1.1 * *rise), Positions{17});
    EXPECT_EQ(changesWhen(0.8 * *rise), Positions{});
    EXPECT_FALSE(smallestRise({{1, 2, 3, 4, 5, 6, 7}, single(7)}, 0.01, 0, {}).has_value()) << "too few to be rare";
    EXPECT_FALSE(smallestRise({{}, {}}, 0.01, 0, {}).has_value());
}

} // namespace
} // namespace shadowbench::history
