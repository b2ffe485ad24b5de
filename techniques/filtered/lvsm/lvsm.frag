#include "filtered/prefiltered_map.glsl"
#include "filtered/moments.glsl"
#include "filtered/lvsm/layers.glsl"

uniform float leastVariance;

out float visibility;

void main() {
    FilteredReceiver receiver = filteredReceiver();
    visibility = 1.0;
    if (!receiver.known) return;
    int layer = layerOf(receiver.depth);
    vec4 moments = filtered(receiver, layer / 2);  // of two layers
    vec2 own = layer % 2 == 0 ? moments.xy : moments.zw;
    visibility = chebyshevBound(own, layerDepth(receiver.depth, layer), leastVariance);
}
