// Level 1 of a min/max pyramid: ACROSS × ACROSS texels, 2 × 2 or with those that the next nodes begin with.
uniform sampler2D depths;
uniform vec4 channel;

out vec2 range;

float inverseDepth(ivec2 texel) {
    if (any(greaterThanEqual(texel, textureSize(depths, 0)))) return 0.0;
    return 1.0 / abs(dot(channel, texelFetch(depths, texel, 0)));
}

void main() {
    ivec2 low = 2 * ivec2(gl_FragCoord.xy);
    range = vec2(inverseDepth(low));
    for (int i = 1; i < ACROSS * ACROSS; ++i) {
        float inverse = inverseDepth(low + ivec2(i % ACROSS, i / ACROSS));
        range = vec2(max(range.x, inverse), min(range.y, inverse));
    }
}
