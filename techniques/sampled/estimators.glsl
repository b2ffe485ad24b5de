// The estimators of soft shadows sampled over time (Scherzer 4.1). ψ is the occluded fraction, ρ of n samples were shadowed.

/// Eq. 4.2: ψ̂ from ρ of n samples.
float occlusionEstimate(float shadowed, float n) {
    return shadowed / n;
}

/// Eq. 4.5: ρ and n after one more sample τ, 0 or 1.
vec2 withSample(vec2 shadowedAndN, float tau) {
    return shadowedAndN + vec2(tau, 1.0);
}

/// Eq. 4.3: variance of ψ̂ from n samples; 0 for n = 1, as Table 4.1 has it.
float occlusionVariance(float estimate, float n) {
    return estimate * (1.0 - estimate) / max(n - 1.0, 1.0);
}

/// Eq. 4.7: mean blocker depth after sample i, which met a blocker at `depth`; the mean began with the k depths of the blocker search.
float blockerUpdate(float previousMean, float depth, float i, float k) {
    return (depth + previousMean * (i - 1.0 + k)) / (i + k);
}
