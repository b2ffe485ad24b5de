#include "gl/receiver.glsl"
#include "shared/maps/slice.glsl"
#include "shared/maps/depth_atlas.glsl"

uniform vec4 eyeDepthFromWorld;  // dot with (p, 1): distance along the view axis

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    float depth = dot(eyeDepthFromWorld, vec4(receiver.position, 1.0));
    int slice = sliceOf(depth);
    visibility = atlasTest(slice, receiver.position);
    float weight = BLEND > 0.0 ? nextWeight(slice, depth) : 0.0;
    if (weight > 0.0) visibility = mix(visibility, atlasTest(slice + 1, receiver.position), weight);
}
