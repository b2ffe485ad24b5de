// Terms 2 t + 1 and 2 t + 2 in texture t: cosine and sine of each, brought from [−1, 1] to [0, 1].
uniform int firstTexture;
uniform float usedDepth;

const float pi = 3.14159265358979;

/// Cosines and sines of c_k = π (2k − 1) times the used depth. Each follows from the two before it: for f = cos or sin,
/// f((2k + 1) x) = 2 cos(2x) f((2k − 1) x) − f((2k − 3) x).
vec4[TEXTURES] storedOf(float depth) {
    float x = pi * usedDepth * depth;
    float first = float(4 * firstTexture + 1) * x;
    vec2 before = vec2(cos(first - 2.0 * x), sin(first - 2.0 * x)), wave = vec2(cos(first), sin(first));
    float twice = 2.0 * cos(2.0 * x);
    vec4 stored[TEXTURES];
    for (int target = 0; target < TEXTURES; ++target) {
        vec2 next = twice * wave - before;
        stored[target] = 0.5 + 0.5 * vec4(wave, next);
        before = next;
        wave = twice * next - wave;
    }
    return stored;
}

#include "filtered/rows.glsl"
