// Shadow test against one of several depth maps in a texture (shared/maps/depth_atlas.h).
uniform sampler2DShadow depthAtlas;
uniform mat4 atlasFromWorld[TILES];
uniform vec4 innerTiles[TILES];

/// The test of a point of the atlas, its window depth in z. Beside the tile its outermost texels continue.
float atlasTap(int tile, vec3 at) {
    vec4 inner = innerTiles[tile];
    return texture(depthAtlas, vec3(clamp(at.xy, inner.xy, inner.zw), min(at.z, 1.0)));
}

/// 1 lit, 0 shadowed. Behind the light: lit.
float atlasTest(int tile, vec3 world) {
    vec4 h = atlasFromWorld[tile] * vec4(world, 1.0);
    return h.w <= 0.0 ? 1.0 : atlasTap(tile, h.xyz / h.w);
}
