// One map of the whole scene.
#include "shared/maps/light_space.glsl"

uniform vec4 depthFromWorld;
uniform vec2 nearAndFar;
uniform vec2 mapSpan;

float nearDistance() {
    return nearAndFar.x;
}

/// Metres along the light's axis of a window depth.
float metresOf(float window) {
    return mix(nearAndFar.x, nearAndFar.y, linearised(window));
}

SoftReceiver softReceiver(vec3 world, vec3 normal) {
    MapPoint point = mapPoint(world);
    vec2 slope = followPlane * receiverPlaneSlope(world, normal, point.at);
    return SoftReceiver(point.at, slope, dot(depthFromWorld, vec4(world, 1.0)), point.behind, mapSpan, 0);
}

/// Beside the map nothing is in the way.
vec2 offsetWithin(SoftReceiver r, vec2 offset) {
    return offset;
}
