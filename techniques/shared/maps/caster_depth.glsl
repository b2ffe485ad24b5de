// How deep a caster lies at a texel's centre, in a map that a point sees (shared/maps/linear_depth_map.h): as 1 / depth, which is
// linear over the map on planes.
//
// A rasteriser moves corners onto a grid of 1/256 texel to decide which centres a triangle covers. llvmpipe interpolates between the
// corners as they were before, so that a covered centre may lie half a step along x and along y beside the triangle. Over that the depth
// of a triangle that is seen edge-on changes without bound. A whole step away from the light is never before what is there, and leaves
// half a step for rounding. The depth test sees the same step (`CasterState` of shared/maps/depth_map.h).
const float rasterStep = 1.0 / 256.0;

uniform vec2 inverseRange;  // 1 / depth at the far and at the near plane

/// `slopes`: how many times the greater change of 1 / depth per texel along x or y the caster is moved away from the light. Casters before
/// the near plane are held on it.
float casterInverseDepth(float slopes) {
    vec2 change = abs(vec2(dFdx(gl_FragCoord.w), dFdy(gl_FragCoord.w)));
    float inverse = gl_FragCoord.w - rasterStep * (change.x + change.y) - slopes * max(change.x, change.y);
    return inverse > inverseRange.x ? min(inverse, inverseRange.y) : inverseRange.x;  // no number where a triangle has no area
}
