// One step of an edge-avoiding à-trous filter of 3 × 3 taps.
#include "modern/ray-classified/classes.glsl"
#include "modern/surface.glsl"

uniform sampler2D source;  // mean and variance
uniform int spacing;       // pixels between taps

out vec2 meanAndVariance;

/// Over 3 × 3 pixels, Gaussian.
float varianceAround(ivec2 pixel) {
    float sum = 0.0;
    ivec2 last = textureSize(source, 0) - 1;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += texelFetch(source, clamp(pixel + ivec2(x, y), ivec2(0), last), 0).g / float((4 << abs(x)) << abs(y));
    return sum;
}

void main() {
    const float kernel[2] = float[](1.0, 2.0 / 3.0);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    meanAndVariance = texelFetch(source, pixel, 0).rg;
    if (classOf(pixel) != mixed) return;
    Surface surface = surfaceAt(pixel);
    if (!surface.seen) return;
    vec2 own = meanAndVariance, sum = own;
    float weights = 1.0, deviation = sqrt(varianceAround(pixel) + 1e-9);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 other = pixel + spacing * ivec2(x, y);
            if (other == pixel || any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, textureSize(source, 0)))) continue;
            Surface there = surfaceAt(other);
            if (!there.seen) continue;
            vec2 tap = texelFetch(source, other, 0).rg;
            float weight = kernel[abs(x)] * kernel[abs(y)] * exp(-abs(tap.r - own.r) / deviation) * exp(-abs(there.depth - surface.depth)) *
                           pow(max(dot(there.normal, surface.normal), 0.0), 32.0);
            sum += vec2(weight, weight * weight) * tap;
            weights += weight;
        }
    meanAndVariance = sum / vec2(weights, weights * weights);
}
