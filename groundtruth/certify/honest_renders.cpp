#include "groundtruth/certify/honest_renders.h"

#include "groundtruth/povray/povray.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::groundtruth {
namespace {

constexpr int setCount = 64;
constexpr double studentQuantile = 4.613;        // of Student's t with 63 degrees of freedom: 1 − 10⁻⁵
constexpr std::uint32_t firstFreeSet = 1U << 21; // sets of the sequence that no render and no certificate of a sky uses
constexpr double leastRms = 0.25;                // of one sample, for logarithms: less is a whole number of samples by luck

std::vector<glm::dvec2> pointsOf(int samples, std::uint32_t set, int from, int to) {
    std::vector<glm::dvec2> points;
    for (int i = from; i < to; ++i) points.push_back(povray::lightSample(i, samples, set));
    return points;
}

std::vector<std::vector<glm::dvec2>> allSets(int samples, std::uint32_t judged) {
    const int quarter = povray::sampleParts(samples).firstQuarter;
    std::vector<std::vector<glm::dvec2>> sets{pointsOf(samples, judged, 0, samples)};
    for (std::uint32_t set = firstFreeSet; set < firstFreeSet + setCount; ++set) {
        sets.push_back(pointsOf(samples, set, 0, quarter));
        sets.push_back(pointsOf(samples, set, quarter, samples));
    }
    return sets;
}

/// Mean and standard deviation of one further draw, from those at hand.
struct Spread {
    double mean, deviation;
};
Spread spreadOf(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    double mean = 0, square = 0;
    for (const double value : values) mean += value / count;
    for (const double value : values) square += (value - mean) * (value - mean) / (count - 1);
    return {mean, std::sqrt(square * (1 + 1 / count))};
}

double upperQuantile(const Spread& spread) { return spread.mean + studentQuantile * spread.deviation; }

} // namespace

HonestRenders::HonestRenders(LightKind kind, int samples, std::uint32_t set)
    : samples_(samples), points_(kind, allSets(samples, set)), sums_(setCount) {}

void HonestRenders::add(double fraction, const std::vector<int>& visible) {
    const double quarterCount = points_.sizes()[1];
    for (std::size_t set = 0; set < sums_.size(); ++set) {
        const int quarter = visible[1 + 2 * set], rest = visible[2 + 2 * set];
        const double error = static_cast<double>(quarter + rest) / samples_ - fraction;
        const double errorOfQuarter = quarter / quarterCount - fraction;
        sums_[set].error += error;
        sums_[set].square += error * error;
        sums_[set].squareOfQuarter += errorOfQuarter * errorOfQuarter;
    }
    ++added_;
}

HonestBounds HonestRenders::bounds() const {
    std::vector<double> bias, rms, fall;
    for (const Sums& sums : sums_) {
        const double least = leastRms / samples_;
        const double all = std::max(least, std::sqrt(sums.square / added_));
        const double quarter = std::max(least, std::sqrt(sums.squareOfQuarter / added_));
        bias.push_back(sums.error / added_);
        rms.push_back(std::log(all));
        fall.push_back(std::log(all / quarter));
    }
    const Spread biases = spreadOf(bias);
    return {std::abs(biases.mean) + studentQuantile * biases.deviation, std::exp(upperQuantile(spreadOf(rms))),
            std::exp(upperQuantile(spreadOf(fall)))};
}

} // namespace shadowbench::groundtruth
