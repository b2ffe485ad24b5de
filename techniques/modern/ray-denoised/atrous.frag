// One iteration of an edge-avoiding à-trous filter (Dammertz et al. 2010; Schied et al. 2017, 4.3 and 4.4).
#include "modern/surface.glsl"

uniform sampler2D source;  // mean and variance
uniform int spacing;       // pixels between taps

out vec2 meanAndVariance;

/// Over 3 × 3 pixels, Gaussian: one pixel's own is too noisy to guide by.
float varianceAround(ivec2 pixel) {
    float sum = 0.0;
    ivec2 last = textureSize(source, 0) - 1;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += texelFetch(source, clamp(pixel + ivec2(x, y), ivec2(0), last), 0).g / float((4 << abs(x)) << abs(y));
    return sum;
}

/// Eq. 5: how far visibilities may differ is as many standard deviations.
float nearness(float difference, float variance) {
#ifdef GUIDED
    const float deviations = 4.0;
    return exp(-abs(difference) / (deviations * sqrt(variance) + 1e-3));
#else
    return 1.0;
#endif
}

void main() {
    const float kernel[3] = float[](3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface = surfaceAt(pixel);
    vec2 own = texelFetch(source, pixel, 0).rg;
    meanAndVariance = own;
    if (!surface.seen) return;
    float variance = varianceAround(pixel);
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            ivec2 other = pixel + spacing * ivec2(x, y);
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, textureSize(source, 0)))) continue;
            vec2 tap = texelFetch(source, other, 0).rg;
            float weight = kernel[abs(x)] * kernel[abs(y)] * likeness(surface, surfaceAt(other)) * nearness(tap.r - own.r, variance);
            sum += vec2(weight, weight * weight) * tap;
            weights += weight;
        }
    meanAndVariance = sum / vec2(weights, weights * weights);
}
