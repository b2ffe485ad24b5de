#include "gl/normal.glsl"
#include "gl/receiver.glsl"
#include "shared/maps/slice.glsl"
#include "shared/maps/depth_atlas.glsl"
#include "shared/maps/plane_slope.glsl"

uniform vec4 eyeDepthFromWorld;  // dot with (p, 1): distance along the view axis
uniform float followPlane;       // 1: taps are compared with the receiver's plane, 0: with the receiver's depth

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    vec4 world = vec4(receiver.position, 1.0);
    int slice = sliceOf(dot(eyeDepthFromWorld, world));
    vec4 h = atlasFromWorld[slice] * world;
    if (h.w <= 0.0) return;
    vec3 at = h.xyz / h.w;
    vec2 slope = followPlane * planeSlope(atlasFromWorld[slice], normalAt(gl_FragCoord.xy), at);
    vec2 halfTexel = 0.5 / vec2(textureSize(depthAtlas, 0));
    float passed = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 offset = halfTexel * (2.0 * vec2(i & 1, i >> 1) - 1.0);
        passed += atlasTap(slice, at + vec3(offset, dot(slope, offset)));
    }
    visibility = passed / 4.0;
}
