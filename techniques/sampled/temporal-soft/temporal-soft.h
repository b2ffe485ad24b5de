// The estimators of temporally sampled soft shadows, free of GL (Scherzer 4.1). ψ is the occluded fraction.
#pragma once

namespace shadowbench::techniques {

/// Eq. 4.2: ψ̂_n from ρ_n shadowed of n samples.
double occlusionEstimate(double shadowed, double n);

/// Eq. 4.5: ψ̂ after one more sample τ ∈ {0, 1}.
double occlusionUpdate(double shadowed, double n, double tau);

/// Eq. 4.3: unbiased estimate of the variance of ψ̂_n; 0 for n = 1, as Table 4.1 has it.
double occlusionVariance(double estimate, double n);

/// Eq. 4.7: mean blocker depth after sample i, started from k depths of the blocker search.
double blockerUpdate(double previousMean, double depth, double i, double k);

} // namespace shadowbench::techniques
