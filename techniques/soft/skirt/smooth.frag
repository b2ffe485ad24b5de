// One pass: the mean attenuation of a texel and its eight neighbours, and the least depth of them. Edges keep their attenuation of 1.
uniform sampler2D skirt;  // attenuation, 1 / depth

out vec2 smoothed;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(skirt, 0) - 1;
    float own = texelFetch(skirt, texel, 0).r;
    smoothed = vec2(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec2 neighbour = texelFetch(skirt, clamp(texel + ivec2(x, y), ivec2(0), last), 0).rg;
            smoothed = vec2(smoothed.r + neighbour.r / 9.0, max(smoothed.g, neighbour.g));
        }
    if (own == 1.0) smoothed.r = 1.0;
}
