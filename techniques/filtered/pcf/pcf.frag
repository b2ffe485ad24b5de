#include "shared/filters/pcf.glsl"
#include "shared/maps/tested_point.glsl"

uniform sampler2DShadow depthMap;
#if KERNEL > 2
uniform float followPlane;  // 1: taps are compared with the receiver's plane, 0: with the receiver's depth
#endif

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = testedPoint(receiver);
    vec2 slope = vec2(0.0);
#if KERNEL > 2
    slope = followPlane * receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at);
#endif
    const int taps = KERNEL == 2 ? 1 : KERNEL; // one of the hardware's 2×2
    visibility = receiver.seen ? percentageCloser(depthMap, point, slope, taps) : 1.0;
}
