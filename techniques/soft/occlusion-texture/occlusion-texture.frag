#include "gl/receiver.glsl"
#include "shared/filters/occluder_layers.glsl"
#include "shared/maps/light_space.glsl"

uniform float inverseNear;  // 1 / depth where the first slice begins
uniform float thickness;    // of a slice, in 1 / depth
uniform int slices;
uniform vec4 depthFromWorld;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    MapPoint point = mapPoint(receiver.position);
    if (point.behind) return;
    float depth = dot(depthFromWorld, vec4(receiver.position, 1.0));
    float depthInSlices = (inverseNear - 1.0 / depth) / thickness;
    for (int slice = 0; slice < slices && float(slice + 1) < depthInSlices; ++slice) {
        float before = min(depthInSlices - float(slice + 1), 1.0);
        float reach = (depthInSlices - float(slice) - 0.5) * thickness;
        visibility *= 1.0 - before * occlusion(slice, point.at.xy, reach);
    }
}
