// Variance shadow map test (Donnelly and Lauritzen 2006).

/// Largest share of depths ≥ `depth` that a distribution with these moments can have.
float chebyshevBound(vec2 moments, float depth, float leastVariance) {
    if (depth <= moments.x) return 1.0;
    float variance = max(moments.y - moments.x * moments.x, leastVariance);
    float beyond = depth - moments.x;
    return variance / (variance + beyond * beyond);
}

/// Maps [amount, 1] to [0, 1] and what lies below to 0.
float withoutBleeding(float visibility, float amount) {
    return clamp((visibility - amount) / (1.0 - amount), 0.0, 1.0);
}
