#include "harness/studies/claims/mean_interval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace shadowbench {
namespace {

/// Two-sided 95 % quantile of Student's t. From 16 numbers on that of 16, which is a little too wide.
double studentT(std::size_t numbers) {
    constexpr std::array quantiles{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                   2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131};
    return quantiles[std::min(numbers - 2, quantiles.size() - 1)];
}

} // namespace

MeanInterval meanInterval(const std::vector<double>& numbers) {
    const auto isFirst = [&](double number) { return number == numbers.front(); };
    if (std::ranges::all_of(numbers, isFirst)) return {numbers.front(), 0}; // not what rounding leaves of it
    const auto count = static_cast<double>(numbers.size());
    const double mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) / count;
    double squares = 0;
    for (const double number : numbers) squares += (number - mean) * (number - mean);
    return {mean, studentT(numbers.size()) * std::sqrt(squares / (count - 1) / count)};
}

} // namespace shadowbench
