// Mean of KERNEL × KERNEL bilinear lookups a texel apart. Along an axis they weigh KERNEL + 1 texels: the first by 1 − share, the last by
// share, all between by 1. Half as many lookups do the same: each lies between two neighbouring texels, where the bilinear filter weighs
// the two as they are to be weighed.
uniform sampler2D shadow;  // 0 where the projected shadow lies; filtered bilinearly

const int pairsOfTexels = (KERNEL + 1) / 2;

vec2 weightOfFirst(ivec2 pair, vec2 share) {
    return mix(vec2(1.0), 1.0 - share, equal(pair, ivec2(0)));
}

vec2 weightOfSecond(ivec2 pair, vec2 share) {
    return mix(vec2(1.0), share, equal(pair, ivec2(pairsOfTexels - 1)));
}

/// `at`: the middle of the lookups.
float boxMean(vec2 at) {
    vec2 size = vec2(textureSize(shadow, 0));
    vec2 lowest = at * size - 0.5 * float(KERNEL);  // lookup, counted in texels from the centre of the first
    vec2 first = floor(lowest), share = lowest - first;
    float dark = 0.0;  // so that no rounding of the weights darkens what is lit
    for (int y = 0; y < pairsOfTexels; ++y)
        for (int x = 0; x < pairsOfTexels; ++x) {
            ivec2 pair = ivec2(x, y);
            vec2 second = weightOfSecond(pair, share), weight = weightOfFirst(pair, share) + second;
            dark += weight.x * weight.y * (1.0 - texture(shadow, (first + vec2(2 * pair) + 0.5 + second / weight) / size).r);
        }
    return max(1.0 - dark / float(KERNEL * KERNEL), 0.0);
}
