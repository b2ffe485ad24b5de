// Shadow test against one of several depth maps in a texture (shared/maps/depth_atlas.h).
uniform sampler2DShadow depthAtlas;
uniform mat4 atlasFromWorld[TILES];
uniform vec4 innerTiles[TILES];

/// 1 lit, 0 shadowed. Beside the tile its outermost texels continue; behind the light: lit.
float atlasTest(int tile, vec3 world) {
    vec4 h = atlasFromWorld[tile] * vec4(world, 1.0);
    if (h.w <= 0.0) return 1.0;
    vec4 inner = innerTiles[tile];
    return texture(depthAtlas, vec3(clamp(h.xy / h.w, inner.xy, inner.zw), min(h.z / h.w, 1.0)));
}
