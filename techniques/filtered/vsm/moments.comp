vec4[TEXTURES] storedOf(float depth) {
    return vec4[](vec4(depth, depth * depth, 0.0, 0.0));
}

#include "filtered/rows.glsl"
