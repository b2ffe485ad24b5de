// Normal offset (shared/maps/normal_offset.h).
#include "shared/maps/light_space.glsl"

uniform float normalOffset;  // factor
uniform vec2 mapTexels;      // of the map, along x and y

/// The receiver moved along its unit normal by `normalOffset` times as much as lifts it by what its plane's depth changes by over half a
/// texel in x and in y. Where map depth is linear along the light that is half the texel's extent times the sine between normal and light.
vec3 movedReceiver(vec3 world, vec3 normal) {
    vec4 h = mapFromWorld * vec4(world, 1.0);
    vec4 hn = mapFromWorld * vec4(normal, 0.0);
    vec3 at = h.xyz / h.w;
    vec3 perMetre = (hn.xyz - at * hn.w) / h.w;  // along the normal
    vec2 slope = receiverPlaneSlope(world, normal, at);
    float lift = dot(slope, perMetre.xy) - perMetre.z;
    vec2 perTexel = abs(slope) / mapTexels;
    return lift > 0.0 ? world + normalOffset * 0.5 * (perTexel.x + perTexel.y) / lift * normal : world;
}
