#include "gl/receiver.glsl"
#include "shared/filters/occluder_layers.glsl"
#include "shared/maps/light_space.glsl"
#include "soft/convolution/layer_of.glsl"

uniform usampler2D ids;
uniform int layers;
uniform vec4 inverseDepths[32];  // x: of each cluster's plane
uniform vec4 depthFromWorld;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    MapPoint point = mapPoint(receiver.position);
    if (point.behind) return;
    float depth = dot(depthFromWorld, vec4(receiver.position, 1.0));
    int ownLayer = int(layerOf[texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r]);
    for (int layer = 0; layer < layers; ++layer) {
        float reach = inverseDepths[layer].x - 1.0 / depth;
        if (layer == ownLayer || reach <= 0.0) continue;
        visibility *= 1.0 - occlusion(layer, point.at.xy, reach);
    }
}
