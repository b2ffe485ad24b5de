#include "filtered/deep-sm/transmittance.glsl"
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2D normals;
uniform float followPlane;  // 1: texels are read at the depth of the receiver's plane, 0: at the receiver's depth

out float visibility;

/// The four functions around the receiver, interpolated.
float filteredTransmittance(vec3 at, vec2 slope) {
    vec2 position = at.xy * float(side) - 0.5;
    vec2 corner = floor(position);
    vec2 share = position - corner;
    float stopped = 0.0;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            vec2 texel = corner + vec2(x, y);
            vec2 weight = mix(1.0 - share, share, vec2(x, y));
            float depth = at.z + dot(slope, (texel - position) / float(side));
            stopped += weight.x * weight.y * (1.0 - transmittanceAt(ivec2(texel), depth));
        }
    return clamp(1.0 - stopped, 0.0, 1.0);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    vec3 normal = normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    visibility = filteredTransmittance(point.at, followPlane * receiverPlaneSlope(receiver.position, normal, point.at));
}
