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
    visibility = chebyshevBound(filtered(receiver, layer).rg, layerDepth(receiver.depth, layer), leastVariance);
}
