// Depth of a triangle at a texel's centre, where that lies within it.
#include "maps/sm-log/log.glsl"

uniform float texel;
uniform float factor;  // of the change of depth per texel
uniform float units;   // of depth

flat in vec2 origin;
flat in vec3 side0, side1, side2;
flat in vec3 depth;

void main() {
    vec2 at = onPlane(gl_FragCoord.xy * texel);
    vec3 here = vec3(at - origin, 1.0);
    // A triangle seen edge-on has no numbers here, and is not drawn.
    if (!all(greaterThanEqual(vec3(dot(side0, here), dot(side1, here), dot(side2, here)), vec3(0.0)))) discard;
    vec2 slope = texel * abs(vec2(depth.x * slopes.y * at.y, warp.y * dot(depth.xy, at)));
    gl_FragDepth = clamp(0.5 + 0.5 * (dot(depth, here) + factor * max(slope.x, slope.y)) + units, 0.0, 1.0);
}
