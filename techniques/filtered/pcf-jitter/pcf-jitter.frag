#include "shared/filters/jitter_table.glsl"
#include "shared/maps/tested_point.glsl"

uniform sampler2DShadow depthMap;
uniform sampler2D jitter;
uniform float followPlane;  // 1: taps are compared with the receiver's plane, 0: with the receiver's depth

const int firstTaps = 8;  // the disk's outermost ring

out float visibility;

float testAt(MapPoint point, vec2 slope, vec2 offset) {
    return texture(depthMap, point.at + vec3(offset, dot(slope, offset)));
}

float jitteredVisibility(MapPoint point, vec2 slope) {
    vec2 reach = RADIUS / vec2(textureSize(depthMap, 0));
    float passed = 0.0;
    int pair = 0;
    for (; pair < firstTaps / 2; ++pair) {
        vec4 offsets = jitteredPair(jitter, pair) * reach.xyxy;
        passed += testAt(point, slope, offsets.xy) + testAt(point, slope, offsets.zw);
    }
    bool decided = passed == 0.0 || passed == float(firstTaps);
    int last = decided ? pair : TAPS / 2;
    for (; pair < last; ++pair) {
        vec4 offsets = jitteredPair(jitter, pair) * reach.xyxy;
        passed += testAt(point, slope, offsets.xy) + testAt(point, slope, offsets.zw);
    }
    return passed / float(2 * last);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = testedPoint(receiver);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    visibility = jitteredVisibility(point, followPlane * receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at));
}
