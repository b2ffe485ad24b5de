#include "filtered/prefiltered_map.glsl"

uniform float c;

out float visibility;

void main() {
    FilteredReceiver receiver = filteredReceiver();
    visibility = 1.0;
    if (!receiver.known) return;
    visibility = min(exp(-c * receiver.depth) * filtered(receiver, 0).r, 1.0);
}
