// Moments of exponentially warped depth (Lauritzen and McCool 2008, "Exponential Variance Shadow Maps"). The warp exp(c d) draws what lies
// before a receiver together, so that several occluders have hardly any variance left; it draws what lies behind apart. The warp
// -exp(-c d) is its mirror image: a bound by each, of which the less counts.
#include "filtered/moments.glsl"

#if defined(FORMAT_RG16F) || defined(FORMAT_RGBA16F)
const float steepest = 5.54;  // 16-bit floats hold exp(2 · 5.54)
#else
const float steepest = 42.0;  // and 32-bit ones exp(2 · 42)
#endif
const vec2 exponents = min(vec2(POSITIVE, NEGATIVE), steepest);  // of depths in [−1, 1]

/// Both warps of a depth in [0, 1].
vec2 warped(float depth) {
    vec2 power = exponents * (2.0 * depth - 1.0);
    return vec2(exp(power.x), -exp(-power.y));
}

/// The positive warp and its square, the negative one and its square.
vec4 momentsOf(float depth) {
    vec2 warps = warped(depth);
    return vec4(warps.x, warps.x * warps.x, warps.y, warps.y * warps.y);
}

/// Chebyshev's bound by one warp. All is divided by the receiver's own warp, so that the least variance, which is one of depths, is
/// multiplied by the square of how fast the warp changes there, 2 c.
float boundBy(vec2 moments, float warp, float exponent) {
    float scale = 1.0 / abs(warp);
    float leastVariance = VARIANCE * 4.0 * exponent * exponent;
    return chebyshevBound(moments * vec2(scale, scale * scale), sign(warp), leastVariance);
}

/// The largest share of depths ≥ `depth` that the moments allow.
float litShare(vec4 moments, float depth) {
    vec2 warps = warped(depth);
    float bound = boundBy(moments.xy, warps.x, exponents.x);
#if defined(FORMAT_RGBA16F) || defined(FORMAT_RGBA32F)
    bound = min(bound, boundBy(moments.zw, warps.y, exponents.y));
#endif
    return bound;
}
