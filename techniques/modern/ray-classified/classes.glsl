// What the rays of a tile and of its neighbours have seen.
const uint shadowed = 0u, lit = 1u, mixed = 2u;

uniform usampler2D tiles;

uint classOf(ivec2 pixel) {
    return texelFetch(tiles, pixel / 8, 0).r;
}
