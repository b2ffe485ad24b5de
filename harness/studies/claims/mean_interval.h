// The mean of a figure over seeds, and how sure it is.
#pragma once

#include <vector>

namespace shadowbench {

/// The 95 % interval of the mean by Student's t: mean ± halfWidth. One number has the half width 0.
struct MeanInterval {
    double mean, halfWidth;
};

/// For one finite number or more.
MeanInterval meanInterval(const std::vector<double>& numbers);

} // namespace shadowbench
