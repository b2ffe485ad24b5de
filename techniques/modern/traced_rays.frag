// The share of a pixel's rays to random points of the light that are free (techniques/modern/traced_rays.h).
#include "gl/normal.glsl"
#include "gl/receiver.glsl"
#include "modern/triangle_tree.glsl"
#include "shared/sampling/pcg.glsl"

uniform vec3 lightCentre, lightU, lightV;
uniform int disk;    // 1: u and v are diameters
uniform float lift;  // metres that rays begin above their surface
uniform int frame;
uniform int seed;

out float visibility;

float chance(uint value) {
    return float(hashed(value) >> 8) / 16777216.0;
}

/// A point of the light of [0, 1)², all areas alike.
vec3 lightPoint(vec2 at) {
    float angle = 6.28318530718 * at.x;
    vec2 share = disk != 0 ? 0.5 * sqrt(at.y) * vec2(cos(angle), sin(angle)) : at - 0.5;
    return lightCentre + share.x * lightU + share.y * lightV;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    vec3 from = receiver.position + lift * normalAt(gl_FragCoord.xy);
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint own = hashed(pixel.x + hashed(pixel.y + hashed(uint(frame) + hashed(uint(seed)))));
    float seen = 0.0;
    for (uint i = 0u; i < uint(RAYS); ++i)
        if (!segmentIsBlocked(from, lightPoint(vec2(chance(own + 2u * i), chance(own + 2u * i + 1u))))) ++seen;
    visibility = seen / float(RAYS);
}
