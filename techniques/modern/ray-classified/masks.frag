// A bit for each ray of a tile of 8 × 4 pixels that is free, row by row; those beside the image are those of its border.
uniform sampler2D noisy;

out uint mask;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * ivec2(8, 4), last = textureSize(noisy, 0) - 1;
    mask = 0u;
    for (int i = 0; i < 32; ++i)
        if (texelFetch(noisy, min(first + ivec2(i & 7, i >> 3), last), 0).r > 0.5) mask |= 1u << uint(i);
}
