/// The surface point that a pixel sees; w = 0 for background.
vec4 pointOf(sampler2D positions, uint pixel) {
    int width = textureSize(positions, 0).x;
    return texelFetch(positions, ivec2(int(pixel) % width, int(pixel) / width), 0);
}
