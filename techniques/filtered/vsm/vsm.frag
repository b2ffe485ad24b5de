#include "filtered/prefiltered_map.glsl"
#include "filtered/moments.glsl"

uniform float leastVariance;
uniform float bleeding;

out float visibility;

void main() {
    FilteredReceiver receiver = filteredReceiver();
    visibility = 1.0;
    if (!receiver.known) return;
    vec2 moments = filtered(receiver, 0).rg;
    visibility = withoutBleeding(chebyshevBound(moments, receiver.depth, leastVariance), bleeding);
}
