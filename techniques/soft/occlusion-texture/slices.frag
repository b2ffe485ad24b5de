in float linearDepth;

uniform float inverseNear;  // 1 / depth where the first slice begins
uniform float thickness;    // of a slice, in 1 / depth
uniform int slices;

out uint bits;

void main() {
    bits = 1u << uint(clamp(int((inverseNear - 1.0 / linearDepth) / thickness), 0, slices - 1));
}
