// Two layers in each texture.
#include "filtered/lvsm/layers.glsl"

vec4[TEXTURES] storedOf(float depth) {
    vec4 moments[TEXTURES];
    for (int target = 0; target < TEXTURES; ++target) {
        vec2 layers = vec2(layerDepth(depth, 2 * target), layerDepth(depth, 2 * target + 1));
        moments[target] = vec4(layers.x, layers.x * layers.x, layers.y, layers.y * layers.y);
    }
    return moments;
}

#include "filtered/rows.glsl"
