#include "filtered/prefiltered_map.glsl"

uniform float usedDepth;
uniform float offset;
uniform float damping;
uniform float gain;

out float visibility;

const float pi = 3.14159265358979;

/// Term k of the step at z − d, averaged over the kernel: `wave` holds the means of cos(c_k z) and sin(c_k z).
float term(int k, float depth, vec2 wave) {
    float frequency = pi * float(2 * k - 1);
    float angle = frequency * depth;
    float share = float(k) / float(TERMS);
    return exp(-damping * share * share) * 2.0 / frequency * (cos(angle) * wave.y - sin(angle) * wave.x);
}

void main() {
    FilteredReceiver receiver = filteredReceiver();
    visibility = 1.0;
#ifdef SERIES  // the sum as it is, where there is one: to be measured
    if (!receiver.known) discard;
#else
    if (!receiver.known) return;
#endif
    float depth = usedDepth * receiver.depth - offset;
    float sum = 0.5;
    for (int layer = 0; layer < TERMS / 2; ++layer) {
        vec4 waves = 2.0 * filtered(receiver, layer) - 1.0;
        sum += term(2 * layer + 1, depth, waves.xy) + term(2 * layer + 2, depth, waves.zw);
    }
#ifdef SERIES
    visibility = sum;
#else
    visibility = clamp(gain * sum, 0.0, 1.0);
#endif
}
