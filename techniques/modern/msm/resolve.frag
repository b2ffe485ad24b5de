#include "filtered/footprint.glsl"
#include "moments.glsl"

uniform sampler2D means;

out float visibility;

/// By which the receiver is moved to the light, so that its own plane does not shade it.
float reachOfReceiver() {
    vec3 position = receiverAt(gl_FragCoord.xy).position, normal = normalAt(gl_FragCoord.xy);
    mat2 perPixel = footprint(position, normal);
    vec2 halfKernel = 0.5 * (vec2(KERNEL) / float(MAP) + abs(perPixel[0]) + abs(perPixel[1]));
    return reachOfPlane(planeSlope(position, normal) * halfKernel);
}

void main() {
    FilteredReceiver receiver = filteredReceiver(float(MAP));
    visibility = 1.0;
    if (!receiver.known) return;
    vec4 moments = filtered(means, receiver);
#ifdef FORMAT_RGBA16
    moments = dequantised(moments);
#endif
    visibility = clamp(1.0 - shadowedShare(moments, receiver.depth - reachOfReceiver(), BIAS), 0.0, 1.0);
}
