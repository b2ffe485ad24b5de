// What sampled/estimators.glsl computes (Scherzer 4.1). ψ is the occluded fraction.
#pragma once

namespace shadowbench::models {

/// Eq. 4.2: ψ̂_n from ρ_n shadowed of n samples.
inline double occlusionEstimate(double shadowed, double n) { return shadowed / n; }

/// Eq. 4.5: ψ̂ after one more sample τ ∈ {0, 1}.
inline double occlusionUpdate(double shadowed, double n, double tau) { return (tau + shadowed) / (n + 1); }

/// Eq. 4.3: unbiased estimate of the variance of ψ̂_n; 0 for n = 1, as Table 4.1 has it.
inline double occlusionVariance(double estimate, double n) { return n > 1 ? estimate * (1 - estimate) / (n - 1) : 0; }

/// Eq. 4.7: mean blocker depth after sample i, started from k depths of the blocker search.
inline double blockerUpdate(double previousMean, double depth, double i, double k) {
    return (depth + previousMean * (i - 1 + k)) / (i + k);
}

} // namespace shadowbench::models
