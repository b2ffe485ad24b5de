#include "shared/maps/tested_point.glsl"
#include "shared/sampling/pcg.glsl"

uniform sampler2DShadow depthMap;
uniform float followPlane;  // 1: taps are compared with the receiver's plane, 0: with the receiver's depth
uniform vec2 disk[TAPS];    // in the unit disk
uniform int seed;

out float visibility;

/// An even spread over [0, 2π) that neighbouring pixels do not share.
float angleOf(uvec2 pixel) {
    return float(hashed(pixel.x + 65536u * pixel.y + 2654435769u * uint(seed))) * (6.28318530718 / 4294967296.0);
}

float diskVisibility(MapPoint point, vec2 slope, mat2 turn) {
    vec2 texel = RADIUS / vec2(textureSize(depthMap, 0));
    float passed = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        vec2 offset = turn * disk[i] * texel;
        passed += texture(depthMap, point.at + vec3(offset, dot(slope, offset)));
    }
    return passed / float(TAPS);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = testedPoint(receiver);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    vec2 slope = followPlane * receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at);
#ifdef ROTATE_PIXEL
    float angle = angleOf(uvec2(gl_FragCoord.xy));
#else
    float angle = 0.0;
#endif
    visibility = diskVisibility(point, slope, mat2(cos(angle), sin(angle), -sin(angle), cos(angle)));
}
