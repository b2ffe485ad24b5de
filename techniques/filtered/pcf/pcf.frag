#include "gl/receiver.glsl"
#include "maps/light_space.glsl"

uniform sampler2D normals;
uniform sampler2DShadow depthMap;
uniform float followPlane;  // 1: taps are compared with the receiver's plane, 0: with the receiver's depth

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    if (!receiver.seen || point.behind) {
        visibility = 1.0;
        return;
    }
    vec3 normal = normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    vec2 slope = followPlane * receiverPlaneSlope(receiver.position, normal, point.at);
    vec2 texel = 1.0 / vec2(textureSize(depthMap, 0));
    float passed = 0.0;
    for (int y = 0; y < KERNEL; ++y)
        for (int x = 0; x < KERNEL; ++x) {
            vec2 offset = (vec2(x, y) - 0.5 * float(KERNEL - 1)) * texel;
            passed += texture(depthMap, point.at + vec3(offset, dot(slope, offset)));
        }
    visibility = passed / float(KERNEL * KERNEL);
}
