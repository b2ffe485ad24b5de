#include "shared/maps/caster_depth.glsl"

uniform float thickness;    // of a slice, in 1 / depth
uniform int slices;

out uint bits;

void main() {
    bits = 1u << uint(clamp(int((inverseRange.y - casterInverseDepth(0.0)) / thickness), 0, slices - 1));
}
