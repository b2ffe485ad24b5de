// Jittered taps of a pixel (techniques/shared/filters/jitter_table.h).
uniform vec2 jitterOrigin;  // pixels

/// Taps 2 · pair and 2 · pair + 1 of the pixel's own set, x and y in the unit disk.
vec4 jitteredPair(sampler2D table, int pair) {
    ivec2 inBlock = ivec2(gl_FragCoord.xy + jitterOrigin) % JITTER_BLOCK;
    return texelFetch(table, ivec2(inBlock.x + JITTER_BLOCK * inBlock.y, pair), 0);
}
