// Tests each triangle against the pixels in all cells that its projection may touch; hands on the large ones.
#include "gl/invocation.glsl"
#include "gl/triangles.glsl"
#include "maps/sm-alias-free/hides.glsl"
#include "maps/sm-alias-free/large.glsl"
#include "maps/sm-alias-free/samples.glsl"

uniform sampler2D positions;
uniform int triangleCount;
uniform int instanceCount;
uniform int baseInstance;
uniform vec4 light;
uniform float slack;

void handOn(vec3 v0, vec3 v1, vec3 v2) {
    uint slot = 3u * atomicAdd(largeCount, 1u);
    largeCorners[slot] = vec4(v0, 1.0);
    largeCorners[slot + 1u] = vec4(v1, 1.0);
    largeCorners[slot + 2u] = vec4(v2, 1.0);
}

void castOnCell(int cell, vec3 v0, vec3 v1, vec3 v2) {
    for (uint entry = heads[cell]; entry != 0u; entry = nexts[entry - 1u]) {
        uint pixel = entry - 1u;
        if (shadows[pixel] == 0u && hides(v0, v1, v2, pointOf(positions, pixel).xyz, light, slack)) shadows[pixel] = 1u;
    }
}

void main() {
    uint index = invocation();
    if (index >= uint(triangleCount) * uint(instanceCount)) return;
    uint triangle = index % uint(triangleCount), instance = uint(baseInstance) + index / uint(triangleCount);
    vec3 v0 = worldCorner(triangle, 0u, instance), v1 = worldCorner(triangle, 1u, instance), v2 = worldCorner(triangle, 2u, instance);

    vec4 h0 = mapFromWorld * vec4(v0, 1.0), h1 = mapFromWorld * vec4(v1, 1.0), h2 = mapFromWorld * vec4(v2, 1.0);
    int whichGrid = gridOf(h0.w);
    if (whichGrid == nowhere || gridOf(h1.w) != whichGrid || gridOf(h2.w) != whichGrid) {
        handOn(v0, v1, v2);
        return;
    }
    vec2 p0 = gridPosition(h0), p1 = gridPosition(h1), p2 = gridPosition(h2);
    const float rounding = 0.01;  // cells
    ivec2 low = ivec2(max(min(p0, min(p1, p2)) - rounding, 0.0));
    ivec2 high = min(ivec2(max(p0, max(p1, p2)) + rounding), ivec2(grid - 1));
    ivec2 cells = high - low + 1;
    // Where one test of every pixel costs no more. It also keeps loops short: llvmpipe ends a shader's loops after 65,535 rounds.
    if (16 * cells.x * cells.y > grid * grid) {
        handOn(v0, v1, v2);
        return;
    }
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) castOnCell(cellIndex(whichGrid, ivec2(x, y)), v0, v1, v2);
}
