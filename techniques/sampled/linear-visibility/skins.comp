// Finds the depth discontinuities of a map: each cell between the centres of four texels that one crosses is a piece of its skin.
#include "gl/invocation.glsl"
#include "sampled/linear-visibility/skins.glsl"

layout(std430, binding = 0) buffer Draw { uint vertexCount, instanceCount, firstVertex, baseInstance; };  // GL's indirect draw
layout(std430, binding = 2) buffer Total { uint skins; };                                                 // of the frame

uniform float leastGap;  // of two inverse depths: their penumbra is as wide as a texel

/// The map's rim goes on for ever.
float inverseAt(ivec2 texel) {
    return inverseDepth(clamp(texel, ivec2(0), ivec2(side() - 1)));
}

/// Whether the surface breaks off between a texel and the next one: what lies on either side does not continue to the other.
bool breaksOff(ivec2 texel, ivec2 step) {
    float before = inverseAt(texel - step), here = inverseAt(texel), next = inverseAt(texel + step), after = inverseAt(texel + 2 * step);
    float gap = abs(next - here);
    return min(gap, min(abs(2.0 * here - before - next), abs(2.0 * next - after - here))) > leastGap;
}

void main() {
    uint cell = invocation();
    int cells = side() - 1;
    if (cell >= uint(cells * cells)) return;
    ivec2 low = ivec2(int(cell) % cells, int(cell) / cells);
    const ivec2 x = ivec2(1, 0), y = ivec2(0, 1);
    bool broken = breaksOff(low, x) || breaksOff(low + y, x) || breaksOff(low, y) || breaksOff(low + x, y);
    if (!broken) return;
    skinCells[atomicAdd(vertexCount, 6u) / 6u] = cell;
    atomicAdd(skins, 1u);
}
