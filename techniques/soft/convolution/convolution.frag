#include "gl/receiver.glsl"
#include "shared/filters/occluder_layers.glsl"
#include "shared/maps/light_space.glsl"
#include "soft/convolution/layers_of.glsl"

uniform usampler2D ids;
uniform int layers;
uniform vec4 clusters[32];  // x: 1 / depth of its plane; y: 1 for the last one of a group
uniform vec4 depthFromWorld;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    MapPoint point = mapPoint(receiver.position);
    if (point.behind) return;
    float depth = dot(depthFromWorld, vec4(receiver.position, 1.0));
    uint ownLayers = surfaces[texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r].layers;
    float hidden = 0.0;  // by the group
    for (int layer = 0; layer < layers; ++layer) {
        float reach = clusters[layer].x - 1.0 / depth;
        bool isOwn = (ownLayers >> uint(layer) & 1u) != 0u;
        if (!isOwn && reach > 0.0) hidden += occlusion(layer, point.at.xy, reach);
        if (clusters[layer].y > 0.0) {
            visibility *= max(1.0 - hidden, 0.0);
            hidden = 0.0;
        }
    }
}
