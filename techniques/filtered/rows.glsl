// The first of a box's two passes, straight from the map's depths: means along x of what a technique stores of a depth, which its own
// shader defines before this is included:
//     vec4[TEXTURES] storedOf(float depth)     depth in [0, 1]
// A texel of the means has 2^LEVEL of the map's per side. A pixel here holds PACK of them, which are neighbours along x and so share
// what is read and stored of most depths.
#include "filtered/box.glsl"
#include "filtered/unit_depth.glsl"

layout(location = 0) out vec4 rows[TEXTURES];

/// What is stored of the map's depths within a texel of the means, summed; beside the map nothing is in the way.
vec4[TEXTURES] storedAt(vec2 at, vec2 mapTexel) {
#if LEVEL == 0
    return storedOf(unitDepth(texture(windowDepths, (at + 0.5) * mapTexel).r));
#else
    ivec2 mapSize = textureSize(windowDepths, 0);
    vec2 first = vec2(ivec2(at) * mapSize / (mapSize >> LEVEL)) + 0.5;
    vec4 sum[TEXTURES];
    for (int i = 0; i < TEXTURES; ++i) sum[i] = vec4(0.0);
    for (int y = 0; y < (1 << LEVEL); ++y)
        for (int x = 0; x < (1 << LEVEL); ++x) {
            vec4 stored[TEXTURES] = storedOf(unitDepth(texture(windowDepths, (first + vec2(x, y)) * mapTexel).r));
            for (int i = 0; i < TEXTURES; ++i) sum[i] += stored[i];
        }
    return sum;
#endif
}

/// What PACK neighbours take of the texel that is `offset` texels from the first of them.
#if PACK == 4
vec4 taken(vec4 stored, int offset) {
    return vec4(boxWeight(offset), boxWeight(offset - 1), boxWeight(offset - 2), boxWeight(offset - 3)) * stored.x;
}
#elif PACK == 2
vec4 taken(vec4 stored, int offset) {
    return vec4(boxWeight(offset) * stored.xy, boxWeight(offset - 1) * stored.xy);
}
#else
vec4 taken(vec4 stored, int offset) {
    return boxWeight(offset) * stored;
}
#endif

void main() {
    vec2 mapTexel = 1.0 / vec2(textureSize(windowDepths, 0));
    vec2 first = floor(gl_FragCoord.xy) * vec2(PACK, 1);
    vec4 sum[TEXTURES];
    for (int i = 0; i < TEXTURES; ++i) sum[i] = vec4(0.0);
    for (int offset = -REACH; offset < PACK + REACH; ++offset) {
        vec4 stored[TEXTURES] = storedAt(first + vec2(offset, 0), mapTexel);
        for (int i = 0; i < TEXTURES; ++i) sum[i] += taken(stored[i], offset);
    }
    float texels = WIDTH * float(1 << (2 * LEVEL));
    for (int i = 0; i < TEXTURES; ++i) rows[i] = sum[i] / texels;
}
