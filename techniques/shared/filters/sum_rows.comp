// Sums the bits along a row of a layer.
#include "gl/invocation.glsl"
#include "shared/filters/summed_areas.glsl"

uniform usampler2D bits;
uniform int layers;

void main() {
    int i = int(invocation());
    int layer = i / side, y = i % side;
    if (layer >= layers) return;
    uint sum = 0u;
    for (int x = 0; x < side; ++x) {
        sum += (texelFetch(bits, ivec2(x, y), 0).r >> uint(layer)) & 1u;
        areas[sumIndex(layer, ivec2(x + 1, y + 1))] = sum;
    }
}
