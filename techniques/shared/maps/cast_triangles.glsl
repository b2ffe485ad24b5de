// The main function of a compute shader that includes shared/maps/pixel_lists.glsl and defines
//     void shade(uint pixel, vec3 point, vec3 v0, vec3 v1, vec3 v2)          which adds a triangle's shadow to the results of a pixel
//     const int roundsOfShade                                                of its loops, at most
//     uint shadeLarge(uint pixel, vec3 point, uint first, uint last)         which does so for these triangles of
//                                                                            shared/maps/large_triangles.glsl, and returns how many
//                                                                            it has tested
// It calls shade() for each triangle and each pixel that may lie in the triangle's shadow, and for some that do not. With LARGE it tests
// all pixels against the triangles that were too large for that. ROUNDS: of all loops of an invocation, at most.
#include "gl/invocation.glsl"
#include "gl/triangles.glsl"
#include "shared/maps/large_triangles.glsl"
#include "shared/maps/pixel_lists.glsl"

uniform sampler2D positions;

#ifdef COUNT_TESTS
layout(std430, binding = 7) buffer Tests { uint tests; };
#endif

void count(uint tested) {
#ifdef COUNT_TESTS
    atomicAdd(tests, tested);
#endif
}

#ifdef LARGE

uniform int pixels;
uniform int firstLarge, mostLarge;  // triangles of this dispatch

void main() {
    uint pixel = invocation();
    if (pixel >= uint(pixels)) return;
    vec4 point = pointOf(positions, pixel);
    if (point.w < 0.5) return;
    uint first = uint(firstLarge), last = min(largeCount, uint(firstLarge + mostLarge));
    if (first < last) count(shadeLarge(pixel, point.xyz, first, last));
}

#else

uniform int triangleCount;
uniform int instanceCount;
uniform int baseInstance;
uniform vec2 reach;      // how far the light reaches from its centre in its own view, times depth
uniform float deepest;   // the greatest depth of a receiver, before the light and behind it

const int mostRounds = ROUNDS / (1 + roundsOfShade);

/// How far from its own image in the light's view a corner may cast its shadow (Scherzer 2.3.5: the light's outline, projected through
/// the corner onto the plane of the deepest receiver).
vec2 spread(vec4 h) {
    return reach * max(1.0 / abs(h.w) - 1.0 / deepest, 0.0);
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
    vec2 p0 = h0.xy / h0.w, p1 = h1.xy / h1.w, p2 = h2.xy / h2.w;
    vec2 s0 = spread(h0), s1 = spread(h1), s2 = spread(h2);
    const float rounding = 0.01;  // cells
    ivec2 first = ivec2(max(gridPosition(min(p0 - s0, min(p1 - s1, p2 - s2))) - rounding, 0.0));
    ivec2 last = min(ivec2(gridPosition(max(p0 + s0, max(p1 + s1, p2 + s2))) + rounding), ivec2(grid - 1));
    ivec2 cells = last - first + 1;
    if (16 * cells.x * cells.y > grid * grid) {  // one test of every pixel costs no more
        handOn(v0, v1, v2);
        return;
    }
    // Cells and their lists in one loop, so that invocations that run in step do not wait for each other's lists.
    ivec2 cell = first;
    uint entry = heads[cellIndex(whichGrid, cell)], tested = 0u;
    int round = 0;
    for (; cell.y <= last.y && round < mostRounds; ++round) {
        if (entry != 0u) {
            shade(entry - 1u, pointOf(positions, entry - 1u).xyz, v0, v1, v2);
            entry = nexts[entry - 1u];
            ++tested;
        }
        if (entry == 0u) {
            cell = cell.x < last.x ? cell + ivec2(1, 0) : ivec2(first.x, cell.y + 1);
            if (cell.y <= last.y) entry = heads[cellIndex(whichGrid, cell)];
        }
    }
    if (cell.y <= last.y) handOn(v0, v1, v2);  // pixels that it has met already change no more
    count(tested);
}

#endif
