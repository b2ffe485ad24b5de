#include "gate/paired.h"

#include "harness/measure/statistics.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace shadowbench::gate {
namespace {

std::vector<double> negated(std::vector<double> samples) {
    for (double& sample : samples) sample = -sample;
    return samples;
}

double logFloor(const TimeRule& rule) { return std::log1p(rule.floor); }

/// What each of the three would add to the statistic if it were the head; the first is.
using Scores = std::array<int, 3>;

/// How many of the times are smaller than each, less how many are larger.
Scores places(const std::array<double, 3>& times) {
    Scores result{};
    for (std::size_t i = 0; i < times.size(); ++i)
        for (const double other : times) result[i] += (times[i] > other) - (times[i] < other);
    return result;
}

/// Twice the rank of each value from 1; equal values share the mean of theirs.
std::vector<int> doubledRanks(const std::vector<double>& values) {
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    std::vector<int> ranks;
    for (const double value : values) {
        const auto [first, last] = std::ranges::equal_range(sorted, value);
        ranks.push_back(static_cast<int>(first - sorted.begin()) + static_cast<int>(last - sorted.begin()) + 1);
    }
    return ranks;
}

/// Probability of a sum of the heads' scores at least as large as the one seen, when each of a restart's is equally likely.
double tailOfSum(const std::vector<Scores>& restarts) {
    int sum = 0, reach = 0, divisor = 0;
    for (const Scores& scores : restarts)
        for (const int score : scores) divisor = std::gcd(divisor, score);
    if (divisor == 0) return 1;
    for (const Scores& scores : restarts) {
        sum += scores[0] / divisor;
        reach += std::max(std::ranges::max(scores), -std::ranges::min(scores)) / divisor;
    }
    const auto middle = static_cast<std::ptrdiff_t>(reach);
    std::vector<double> chance(2 * static_cast<std::size_t>(reach) + 1, 0); // of each sum from −reach
    chance[static_cast<std::size_t>(middle)] = 1;
    for (const Scores& scores : restarts) {
        std::vector<double> next(chance.size(), 0);
        for (std::size_t i = 0; i < chance.size(); ++i)
            if (chance[i] > 0)
                for (const int score : scores)
                    next[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + score / divisor)] += chance[i] / 3;
        chance = std::move(next);
    }
    return std::accumulate(chance.begin() + middle + sum, chance.end(), 0.0);
}

} // namespace

double medianLowerBound(std::vector<double> samples, double alpha) {
    const auto n = static_cast<int>(samples.size());
    if (n == 0) return -std::numeric_limits<double>::infinity();
    // The k-th smallest lies above the median when fewer than k samples lie below it: P(Bin(n, ½) ≤ k − 1).
    const boost::math::binomial below(n, 0.5);
    const auto sure = [&](int k) { return boost::math::cdf(below, k) <= alpha; };
    int rank = 0; // the first that is not sure, by bisection
    for (int end = n; rank < end;) {
        const int middle = rank + (end - rank) / 2;
        if (sure(middle))
            rank = middle + 1;
        else
            end = middle;
    }
    if (rank == 0) return -std::numeric_limits<double>::infinity();
    std::nth_element(samples.begin(), samples.begin() + (rank - 1), samples.end());
    return samples[static_cast<std::size_t>(rank - 1)];
}

double hodgesLehmann(const std::vector<double>& samples) {
    std::vector<double> means;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t j = i; j < samples.size(); ++j) means.push_back((samples[i] + samples[j]) / 2);
    return timing::median(means);
}

double logSlowdown(const std::vector<RestartTimes>& restarts) {
    std::vector<double> slowdowns;
    for (const RestartTimes& times : restarts) slowdowns.push_back(times.head - (times.base + times.control) / 2);
    return hodgesLehmann(slowdowns);
}

double quadeTail(const std::vector<RestartTimes>& restarts, double logSlowdown) {
    std::vector<Scores> scores;
    std::vector<double> ranges;
    for (const RestartTimes& times : restarts) {
        const std::array<double, 3> three{times.head - logSlowdown, times.base, times.control};
        scores.push_back(places(three));
        ranges.push_back(std::ranges::max(three) - std::ranges::min(three));
    }
    const std::vector<int> weights = doubledRanks(ranges);
    for (std::size_t i = 0; i < scores.size(); ++i)
        for (int& score : scores[i]) score *= weights[i];
    return tailOfSum(scores);
}

double slowdownLowerBound(const std::vector<RestartTimes>& restarts, double alpha) {
    constexpr double widest = 10; // on both sides of the estimate: more than any times differ by
    constexpr int bisections = 50;
    if (restarts.empty()) return -std::numeric_limits<double>::infinity();
    double refused = logSlowdown(restarts) - widest, open = refused + 2 * widest;
    if (quadeTail(restarts, refused) > alpha) return -std::numeric_limits<double>::infinity();
    for (int i = 0; i < bisections; ++i) { // the tail grows with the slowdown
        const double middle = (refused + open) / 2;
        (quadeTail(restarts, middle) <= alpha ? refused : open) = middle;
    }
    return refused;
}

double smallestTold(const std::vector<RestartTimes>& restarts, const TimeRule& rule, double alpha, int most) {
    constexpr double missed = 0.05;
    std::vector<double> slowdowns;
    for (const RestartTimes& times : restarts) slowdowns.push_back(times.head - (times.base + times.control) / 2);
    const double mean = std::accumulate(slowdowns.begin(), slowdowns.end(), 0.0) / static_cast<double>(slowdowns.size());
    double squares = 0;
    for (const double slowdown : slowdowns) squares += (slowdown - mean) * (slowdown - mean);
    const double deviation = std::sqrt(squares / static_cast<double>(slowdowns.size() - 1));
    const boost::math::normal normal;
    const auto quantile = [&](double share) { return boost::math::quantile(boost::math::complement(normal, share)); };
    const double notPassed = quantile(missed) * deviation / std::sqrt(static_cast<double>(restarts.size()));
    const double alarmed = (quantile(alpha) + quantile(missed)) * deviation / std::sqrt(most);
    return std::expm1(logFloor(rule) + std::max(notPassed, alarmed));
}

TimeVerdict judgeTime(const std::vector<RestartTimes>& restarts, const TimeRule& rule, int cells, int looks) {
    if (restarts.empty()) return TimeVerdict::Unclear;
    const double floor = logFloor(rule);
    if (logSlowdown(restarts) <= floor) return TimeVerdict::Pass;
    return quadeTail(restarts, floor) <= rule.alpha / cells / looks ? TimeVerdict::Slower : TimeVerdict::Unclear;
}

bool controlAlarms(const std::vector<double>& logRatios, const TimeRule& rule, int cells) {
    const double alpha = rule.alpha / cells / 2; // two sides
    return std::max(medianLowerBound(logRatios, alpha), medianLowerBound(negated(logRatios), alpha)) > logFloor(rule);
}

} // namespace shadowbench::gate
