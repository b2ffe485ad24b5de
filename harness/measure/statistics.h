// Order statistics of samples: pure functions.
#pragma once

#include <vector>

namespace shadowbench::timing {

/// Value below which the share `p` in [0, 1] of the samples lies, linear between order statistics: samples of time are few.
/// (metrics::quantile, over the many pixels of an image, gives a value that occurs.) Samples must not be empty.
double percentile(std::vector<double> samples, double p);

double median(const std::vector<double>& samples);

/// Median absolute deviation from the median.
double medianDeviation(const std::vector<double>& samples);

} // namespace shadowbench::timing
