#include "harness/gate/paired.h"

#include "harness/measure/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>

namespace shadowbench::gate {
namespace {

std::vector<double> negated(std::vector<double> samples) {
    for (double& sample : samples) sample = -sample;
    return samples;
}

double logFloor(const TimeRule& rule) { return std::log1p(rule.floor); }

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

TimeVerdict judgeTime(const std::vector<double>& logRatios, const TimeRule& rule, int cells, int looks) {
    if (logRatios.empty()) return TimeVerdict::Unclear;
    const double floor = logFloor(rule);
    if (timing::median(logRatios) <= floor) return TimeVerdict::Pass;
    return medianLowerBound(logRatios, rule.alpha / cells / looks) > floor ? TimeVerdict::Slower : TimeVerdict::Unclear;
}

bool surelyNotSlower(const std::vector<double>& logRatios, const TimeRule& rule) {
    return -medianLowerBound(negated(logRatios), rule.beta) <= logFloor(rule);
}

bool controlAlarms(const std::vector<double>& logRatios, const TimeRule& rule, int cells) {
    const double alpha = rule.alpha / cells / 2; // two sides
    return std::max(medianLowerBound(logRatios, alpha), medianLowerBound(negated(logRatios), alpha)) > logFloor(rule);
}

} // namespace shadowbench::gate
