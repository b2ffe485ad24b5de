// The first of a box's two passes, straight from the map's depths: means along x of what a technique stores of a depth, which its own
// shader defines before this is included:
//     vec4[TEXTURES] storedOf(float depth)     depth in [0, 1]
// A texel of the means has 2^LEVEL of the map's per side. An invocation goes along a row, so that what is stored of each depth is computed
// for several means at once; PACK of them, which are neighbours along x, are one texel.
#include "filtered/box.glsl"
#include "filtered/unit_depth.glsl"
#include "gl/invocation.glsl"

layout(binding = 0, FORMAT) writeonly uniform image2D rows[TEXTURES];

/// What is stored of the map's depths within a texel of the means, summed; beside the map nothing is in the way.
vec4[TEXTURES] storedAt(vec2 at, vec2 mapTexel) {
#if LEVEL == 0
    return storedOf(unitDepth(textureLod(windowDepths, (at + 0.5) * mapTexel, 0.0).r));
#else
    ivec2 mapSize = textureSize(windowDepths, 0);
    vec2 first = vec2(ivec2(at) * mapSize / (mapSize >> LEVEL)) + 0.5;
    vec4 sum[TEXTURES];
    for (int i = 0; i < TEXTURES; ++i) sum[i] = vec4(0.0);
    for (int y = 0; y < (1 << LEVEL); ++y)
        for (int x = 0; x < (1 << LEVEL); ++x) {
            vec4 stored[TEXTURES] = storedOf(unitDepth(textureLod(windowDepths, (first + vec2(x, y)) * mapTexel, 0.0).r));
            for (int i = 0; i < TEXTURES; ++i) sum[i] += stored[i];
        }
    return sum;
#endif
}

/// The means of one texture, from what is stored of the texels from REACH before the first mean on.
void storeMeans(int target, ivec2 first, vec4[RUN + 2 * REACH] stored) {
    vec4 sums[RUN];
    for (int i = 0; i < RUN; ++i) sums[i] = vec4(0.0);
    for (int offset = -REACH; offset <= REACH; ++offset)
        for (int i = 0; i < RUN; ++i) sums[i] += boxWeight(offset) * stored[i + REACH + offset];
    float texels = WIDTH * float(1 << (2 * LEVEL));
    for (int i = 0; i < RUN; ++i) sums[i] /= texels;
    ivec2 at = first / ivec2(PACK, 1);
#if PACK == 4
    for (int i = 0; i < RUN / 4; ++i)
        imageStore(rows[target], at + ivec2(i, 0), vec4(sums[4 * i].x, sums[4 * i + 1].x, sums[4 * i + 2].x, sums[4 * i + 3].x));
#elif PACK == 2
    for (int i = 0; i < RUN / 2; ++i) imageStore(rows[target], at + ivec2(i, 0), vec4(sums[2 * i].xy, sums[2 * i + 1].xy));
#else
    for (int i = 0; i < RUN; ++i) imageStore(rows[target], at + ivec2(i, 0), sums[i]);
#endif
}

void main() {
    ivec2 size = imageSize(rows[0]) * ivec2(PACK, 1);
    int runs = (size.x + RUN - 1) / RUN, number = int(invocation());
    ivec2 first = ivec2(number % runs * RUN, number / runs);
    if (first.y >= size.y) return;
    vec2 mapTexel = 1.0 / vec2(textureSize(windowDepths, 0));
    vec4 stored[TEXTURES][RUN + 2 * REACH];
    for (int i = 0; i < RUN + 2 * REACH; ++i) {
        vec4 here[TEXTURES] = storedAt(vec2(first + ivec2(i - REACH, 0)), mapTexel);
        for (int target = 0; target < TEXTURES; ++target) stored[target][i] = here[target];
    }
    for (int target = 0; target < TEXTURES; ++target) storeMeans(target, first, stored[target]);
}
