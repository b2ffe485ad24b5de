#include "gl/normal.glsl"
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2DShadow depths;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;

    // A tap beside the receiver is compared with the depth of the receiver's plane there.
    vec2 slope = receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at);
    vec2 texel = 1.0 / vec2(textureSize(depths, 0));
    float passed = 0.0;
    for (int y = 0; y < KERNEL; ++y)
        for (int x = 0; x < KERNEL; ++x) {
            vec2 offset = (vec2(x, y) - 0.5 * float(KERNEL - 1)) * texel;
            passed += texture(depths, point.at + vec3(offset, dot(slope, offset)));
        }
    visibility = passed / float(KERNEL * KERNEL);
}
