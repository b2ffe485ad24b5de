// A map for each slice of the view frustum, tiles of one texture. All are parts of the scene's map (shared/maps/cascade_fit.h), so that
// depths are the same in each.
#include "shared/maps/slice.glsl"

uniform vec4 eyeDepthFromWorld;  // dot with (p, 1): distance along the view axis
uniform mat4 atlasFromWorld[TILES];
uniform vec4 innerTiles[TILES];
uniform vec4 depthFromWorld[TILES];
uniform vec4 metreLinearisation[TILES];
uniform vec2 nearAndFar[TILES];
uniform vec2 mapSpan[TILES];

float nearDistance() {
    return nearAndFar[0].x;
}

/// Metres along the light's axis of a window depth.
float metresOf(float window) {
    return linearised(window, metreLinearisation[0]);
}

/// Width and height of the texture as a slice's map has them: `mapSpan` is that of its tile.
vec2 textureSpan(int slice) {
    vec4 inner = innerTiles[slice];
    return mapSpan[slice] / (inner.zw - inner.xy + 1.0 / vec2(textureSize(depths, 0)));
}

SoftReceiver softReceiver(vec3 world, vec3 normal) {
    int slice = sliceOf(dot(eyeDepthFromWorld, vec4(world, 1.0)));
    vec4 h = atlasFromWorld[slice] * vec4(world, 1.0);
    vec3 at = vec3(h.xy, min(h.z, h.w)) / h.w;
    vec2 slope = followPlane * planeSlope(atlasFromWorld[slice], normal, at);
#ifdef WIDTHS_TEXELS
    vec2 span = textureSpan(0);  // what is so many texels wide in the first map is in all
#else
    vec2 span = textureSpan(slice);
#endif
    return SoftReceiver(at, slope, dot(depthFromWorld[0], vec4(world, 1.0)), h.w <= 0.0, span, slice);
}

/// Beside its tile the outermost texels continue.
vec2 offsetWithin(SoftReceiver r, vec2 offset) {
    return clamp(r.at.xy + offset, innerTiles[r.tile].xy, innerTiles[r.tile].zw) - r.at.xy;
}
