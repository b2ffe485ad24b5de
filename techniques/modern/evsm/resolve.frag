#include "filtered/footprint.glsl"
#include "warp.glsl"

uniform sampler2D means;

out float visibility;

void main() {
    FilteredReceiver receiver = filteredReceiver(float(MAP));
    visibility = receiver.known ? litShare(filtered(means, receiver), receiver.depth) : 1.0;
}
