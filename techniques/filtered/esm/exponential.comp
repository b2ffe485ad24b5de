uniform float c;

vec4[TEXTURES] storedOf(float depth) {
    return vec4[](vec4(exp(c * depth)));
}

#include "filtered/rows.glsl"
