#include "shared/maps/tested_point.glsl"
#include "shared/sampling/vogel.glsl"

uniform sampler2DShadow depths;
uniform float followPlane;
uniform int frame;
uniform int seed;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = testedPoint(receiver);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    vec2 slope = followPlane * receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at);
    vec2 reach = RADIUS / vec2(textureSize(depths, 0));
    float turn = turnOf(gl_FragCoord.xy, frame, seed);
    float passed = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        vec2 offset = reach * vogelTap(i, TAPS, turn);
        passed += texture(depths, point.at + vec3(offset, dot(slope, offset)));
    }
    visibility = passed / float(TAPS);
}
