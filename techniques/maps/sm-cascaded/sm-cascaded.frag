#include "gl/receiver.glsl"
#include "shared/maps/depth_atlas.glsl"

uniform vec4 eyeDepthFromWorld;     // dot with (p, 1): distance along the view axis
uniform vec4 sliceEnds[TILES];      // x: eye depth at which slice i ends

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    float depth = dot(eyeDepthFromWorld, vec4(receiver.position, 1.0));
    int slice = 0;
    while (slice < TILES - 1 && depth > sliceEnds[slice].x) ++slice;
    visibility = atlasTest(slice, receiver.position);
}
