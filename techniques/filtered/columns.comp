// The second of a box's two passes: means along y of the means along x. An invocation goes down a column, so that each of these is
// read for several texels at once.
#include "filtered/box.glsl"
#include "gl/invocation.glsl"

uniform sampler2D rows;  // PACK texels that are neighbours along x in each
layout(binding = 0, FORMAT) writeonly uniform image2D means;

const int run = 16;  // texels that an invocation writes

void store(ivec2 at, vec4 mean) {
#if PACK == 4
    for (int i = 0; i < 4; ++i) imageStore(means, at + ivec2(i, 0), vec4(mean[i]));
#elif PACK == 2
    imageStore(means, at, mean.xyxy);
    imageStore(means, at + ivec2(1, 0), mean.zwzw);
#else
    imageStore(means, at, mean);
#endif
}

void main() {
    ivec2 size = textureSize(rows, 0);
    int number = int(invocation());
    ivec2 first = ivec2(number % size.x, number / size.x * run);
    if (first.y >= size.y) return;
    vec2 texel = 1.0 / vec2(size), at = (vec2(first) + 0.5) * texel;
    vec4 row[run + 2 * REACH], sums[run];
    for (int i = 0; i < run + 2 * REACH; ++i) row[i] = textureLod(rows, at + vec2(0.0, float(i - REACH) * texel.y), 0.0);
    for (int i = 0; i < run; ++i) sums[i] = row[i + REACH];
    for (int offset = 1; offset <= REACH; ++offset)
        for (int i = 0; i < run; ++i)
            sums[i] += boxWeight(offset) * (row[i + REACH - offset] + row[i + REACH + offset]);
    for (int i = 0; i < run; ++i) store(ivec2(first.x * PACK, first.y + i), sums[i] / WIDTH);
}
