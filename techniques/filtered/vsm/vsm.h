// The mathematics of variance shadow maps, as filtered/moments.glsl computes it.
#pragma once

#include "techniques/contract/parameters.h"

namespace shadowbench::techniques {

/// Mean of the depths and of their squares over a filter kernel.
struct Moments {
    double mean = 0, meanSquare = 0;
};

/// One-tailed Chebyshev (Cantelli) bound: the largest share of depths ≥ `depth` that a distribution with these moments can
/// have; 1 where `depth` ≤ mean. The variance is held above `leastVariance`.
double chebyshevBound(const Moments& moments, double depth, double leastVariance = 0);

/// Maps [amount, 1] to [0, 1] and what lies below to 0: hides the leaks up to `amount` and darkens the penumbra by as much
/// (Lauritzen, GPU Gems 3, chapter 8).
double withoutBleeding(double visibility, double amount);

/// `variance`: the least variance of every technique over moments of depths in [0, 1].
Parameter leastVarianceParameter();

} // namespace shadowbench::techniques
