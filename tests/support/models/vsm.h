// What filtered/moments.glsl computes (Donnelly and Lauritzen 2006).
#pragma once

#include <algorithm>

namespace shadowbench::models {

/// Mean of the depths and of their squares over a filter kernel.
struct Moments {
    double mean = 0, meanSquare = 0;
};

/// One-tailed Chebyshev (Cantelli) bound: the largest share of depths ≥ `depth` that a distribution with these moments can
/// have; 1 where `depth` ≤ mean. The variance is held above `leastVariance`.
inline double chebyshevBound(const Moments& moments, double depth, double leastVariance = 0) {
    if (depth <= moments.mean) return 1;
    const double variance = std::max(moments.meanSquare - moments.mean * moments.mean, leastVariance);
    const double beyond = depth - moments.mean;
    return variance / (variance + beyond * beyond);
}

/// Maps [amount, 1] to [0, 1] and what lies below to 0: hides the leaks up to `amount` and darkens the penumbra by as much
/// (Lauritzen, GPU Gems 3, chapter 8).
inline double withoutBleeding(double visibility, double amount) {
    return std::clamp((visibility - amount) / (1 - amount), 0.0, 1.0);
}

} // namespace shadowbench::models
