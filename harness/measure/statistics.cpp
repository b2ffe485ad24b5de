#include "harness/measure/statistics.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::timing {

double percentile(std::vector<double> samples, double p) {
    if (samples.empty()) throw InternalError("a percentile of no samples was asked for");
    std::sort(samples.begin(), samples.end());
    const double position = p * static_cast<double>(samples.size() - 1);
    const auto low = static_cast<std::size_t>(position);
    const std::size_t high = std::min(low + 1, samples.size() - 1);
    return samples[low] + (position - static_cast<double>(low)) * (samples[high] - samples[low]);
}

double median(const std::vector<double>& samples) { return percentile(samples, 0.5); }

double medianDeviation(const std::vector<double>& samples) {
    const double middle = median(samples);
    std::vector<double> deviations;
    for (const double sample : samples) deviations.push_back(std::abs(sample - middle));
    return median(deviations);
}

} // namespace shadowbench::timing
