// What a tile of the map holds: the one surface id in it (0: nothing, −1: several), and its least depth.
uniform sampler2D idMap;

out vec2 tile;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * TILE_SIDE;
    ivec2 end = min(first + TILE_SIDE, textureSize(idMap, 0));
    vec2 held = texelFetch(idMap, first, 0).rg;
    tile = vec2(held.g, held.r);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec2 stored = texelFetch(idMap, ivec2(x, y), 0).rg;
            tile = vec2(stored.g == tile.x ? tile.x : -1.0, min(tile.y, stored.r));
        }
}
