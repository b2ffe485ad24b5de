// Scores of a level-of-detail technique over its pictures (Scherzer and Wimmer 2008, 5.2).
#include "harness/metrics/frames.h"
#include "harness/metrics/scores.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::metrics {
namespace {

double largest(const std::vector<double>& values) { return *std::ranges::max_element(values); }

double sum(const std::vector<double>& values) {
    double total = 0;
    for (const double value : values) total += value;
    return total;
}

} // namespace

std::optional<double> standingPop(const Walk& walk) { return largest(walk.standingChange); }

std::optional<double> standingRegion(const Walk& walk) {
    std::size_t region = 0;
    for (const std::size_t pixels : walk.standingRegion) region = std::max(region, pixels);
    return static_cast<double>(region);
}

std::optional<double> walkPop(const Walk& walk) { return largest(walk.change); }

std::optional<double> colourError(const Walk& walk) {
    return std::sqrt(sum(walk.square) / static_cast<double>(walk.square.size()));
}

std::optional<double> noise(const Walk& walk) {
    if (walk.maskPixels == 0) return {};
    return (sum(walk.speckle) - walk.referenceSpeckle) / static_cast<double>(walk.maskPixels);
}

std::optional<double> orderError(const Walk& walk) { return std::sqrt(walk.orderSquare); }

std::optional<double> transitions(const Walk& walk) { return static_cast<double>(walk.transitions); }

std::optional<double> primitives(const Walk& walk) {
    double mean = 0;
    for (const double count : walk.primitives) mean += count / static_cast<double>(walk.primitives.size());
    return mean;
}

std::optional<double> primitiveChange(const Walk& walk) {
    const std::vector<double>& counts = walk.primitives;
    double change = 0;
    for (std::size_t frame = 2; frame < counts.size(); ++frame)
        change = std::max(change, std::abs(counts[frame] - counts[frame - 1]) / counts[frame - 1]);
    return change;
}

} // namespace shadowbench::metrics
