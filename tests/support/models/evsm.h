// What modern/evsm/warp.glsl computes (Lauritzen and McCool 2008), without the division that keeps it within 32-bit floats.
#pragma once

#include "tests/support/models/vsm.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace shadowbench::models {

/// Depths of a kernel in [0, 1] and the share of each.
using Kernel = std::vector<std::pair<double, double>>;

/// By exp(exponent · d) of d in [−1, 1]; of a negative exponent its mirror image, which grows with depth, too.
inline double warped(double depth, double exponent) { return std::copysign(std::exp(exponent * (2 * depth - 1)), exponent); }

/// Chebyshev's bound of a kernel under one warp.
inline double warpedBound(const Kernel& kernel, double depth, double exponent, double leastVariance) {
    Moments moments;
    for (const auto& [at, share] : kernel) {
        const double warp = warped(at, exponent);
        moments.mean += share * warp;
        moments.meanSquare += share * warp * warp;
    }
    const double here = warped(depth, exponent), slope = 2 * exponent * here;
    return chebyshevBound(moments, here, leastVariance * slope * slope);
}

} // namespace shadowbench::models
