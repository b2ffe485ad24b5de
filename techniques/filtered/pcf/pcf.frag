#include "gl/receiver.glsl"
#include "shared/filters/pcf.glsl"

uniform sampler2DShadow depthMap;
#if KERNEL > 1
uniform sampler2D normals;
uniform float followPlane;  // 1: taps are compared with the receiver's plane, 0: with the receiver's depth
#endif

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    vec2 slope = vec2(0.0);
#if KERNEL > 1
    vec3 normal = normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    slope = followPlane * receiverPlaneSlope(receiver.position, normal, point.at);
#endif
    visibility = receiver.seen ? percentageCloser(depthMap, point, slope, KERNEL) : 1.0;
}
