// Sums the rows' sums along a column of a layer.
#include "gl/invocation.glsl"
#include "shared/filters/summed_areas.glsl"

uniform int layers;

void main() {
    int i = int(invocation());
    int layer = i / side, x = i % side;
    if (layer >= layers) return;
    uint sum = 0u;
    for (int y = 0; y < side; ++y) {
        sum += areas[sumIndex(layer, ivec2(x + 1, y + 1))];
        areas[sumIndex(layer, ivec2(x + 1, y + 1))] = sum;
    }
}
