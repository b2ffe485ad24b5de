// One frame of pixel-correct shadow maps.
#include "gl/half.glsl"
#include "maps/sm-history/history.glsl"
#include "shared/filters/pcf.glsl"
#include "shared/maps/tested_point.glsl"

uniform sampler2DShadow depthMap;
#if KERNEL > 1
uniform float followPlane;            // 1: filter taps are compared with the receiver's plane
#endif
uniform sampler2D previousPositions;  // world position of this pixel's surface point one frame earlier
uniform sampler2D history;            // smoothed visibility, window depth
uniform mat4 clipFromWorld;
uniform mat4 previousClipFromWorld;
uniform float m;
uniform int hasHistory;

layout(location = 0) out float visibility;
layout(location = 1) out vec2 newHistory;

const float depthTolerance = 0.001;  // eq. 3.5

vec3 windowPosition(mat4 clip, vec3 world) {
    vec4 h = clip * vec4(world, 1.0);
    return h.xyz / h.w * 0.5 + 0.5;
}

/// f(n): the shadow test of this frame, filtered or not.
float currentTest(MapPoint point, vec3 world) {
    vec2 slope = vec2(0.0);
#if KERNEL > 1
    slope = followPlane * receiverPlaneSlope(world, normalAt(gl_FragCoord.xy), point.at);
#endif
    return percentageCloser(depthMap, point, slope, KERNEL);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    if (!receiver.seen) {
        visibility = 1.0;
        newHistory = vec2(1.0, 1.0);
        return;
    }
    MapPoint point = testedPoint(receiver);
    visibility = currentTest(point, receiver.position);

    vec3 before = windowPosition(previousClipFromWorld, texelFetch(previousPositions, ivec2(gl_FragCoord.xy), 0).xyz);  // eq. 3.4
    bool inside = all(greaterThanEqual(before.xy, vec2(0.0))) && all(lessThanEqual(before.xy, vec2(1.0)));
    if (hasHistory == 1 && inside) {
        vec2 old = texture(history, before.xy).xy;
        if (abs(old.y - before.z) < depthTolerance) {
            float sure = confidence(point.at.xy * vec2(textureSize(depthMap, 0)));
            visibility = smoothed(old.x, visibility, sure, m);
        }
    }
    newHistory = toHalf(vec2(visibility, windowPosition(clipFromWorld, receiver.position).z));
}
