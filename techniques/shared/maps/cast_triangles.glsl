// The main function of a compute shader that includes shared/maps/pixel_lists.glsl and defines
//     void shade(uint pixel, vec3 point, vec3 v0, vec3 v1, vec3 v2)          which adds a triangle's shadow to the results of a pixel
//     const int roundsOfShade                                                of its loops, at most
//     void shadeLarge(uint pixel, vec3 point, uint first, uint which)        which does so for those of 32 triangles of
//                                                                            shared/maps/large_triangles.glsl whose bits are set
// It calls shade() for each triangle and each pixel that may lie in the triangle's shadow, and for some that do not. With LARGE it tests
// all pixels against the triangles that were too large for that, but for those that hide nothing from any pixel of a tile of 8 × 8.
// ROUNDS: of all loops of an invocation, at most. LIGHTS: corners of the light.
#include "gl/invocation.glsl"
#include "gl/triangles.glsl"
#include "shared/maps/large_triangles.glsl"
#include "shared/maps/pixel_lists.glsl"

#ifdef COUNT_TESTS
layout(std430, binding = 7) buffer Tests { uint tests; };
#endif

void count(uint tested) {
#ifdef COUNT_TESTS
    atomicAdd(tests, tested);
#endif
}

#ifdef LARGE

#include "shared/maps/may_hide.glsl"
#include "shared/maps/ordered.glsl"

uniform int firstLarge;  // of this dispatch
uniform vec4 lights[LIGHTS];

const uint none = 0u;        // below all codes of ordered()
shared uint extremes[6];     // of the tile's points: x, y, z at their greatest, then −x, −y, −z at theirs, in the code of ordered()
shared uint reaching[3][2];  // bits of 64 triangles that may hide something: of this round, the next one and the one before

void waitForAll() {
    memoryBarrierShared();
    barrier();
}

/// A box around the points that the work group's pixels see.
Box tileAround(bool seen, vec3 point) {
    uint here = gl_LocalInvocationIndex;
    if (here < 6u) extremes[here] = none;
    if (here < 2u) reaching[0][here] = 0u;
    waitForAll();
    for (int axis = 0; axis < 3 && seen; ++axis) {
        atomicMax(extremes[axis], ordered(point[axis]));
        atomicMax(extremes[3 + axis], ordered(-point[axis]));
    }
    waitForAll();
    vec3 high = vec3(unordered(extremes[0]), unordered(extremes[1]), unordered(extremes[2]));
    vec3 low = -vec3(unordered(extremes[3]), unordered(extremes[4]), unordered(extremes[5]));
    return Box(0.5 * (low + high), 0.5 * (high - low));
}

void main() {
    uint first = uint(firstLarge), last = min(largeCount, uint(firstLarge + mostLarge));
    ivec2 size = textureSize(positions, 0);
    uint here = gl_LocalInvocationIndex;
    ivec2 at = tileSide * ivec2(gl_WorkGroupID.xy) + ivec2(here % tileSide, here / tileSide);
    vec4 point = all(lessThan(at, size)) ? texelFetch(positions, at, 0) : vec4(0.0);
    bool seen = point.w > 0.5;
    uint pixel = uint(at.y * size.x + at.x), tested = 0u;
    Box box = tileAround(seen, point.xyz);
    int round = 0;
    // Invocations take a triangle each for the tile, then all of those that are left for their own pixels. That bits are cleared a round
    // before they are set leaves one wait a round.
    for (uint block = first; block < last && extremes[0] != none; block += 64u) {
        int next = (round + 1) % 3;
        if (here < 2u) reaching[next][here] = 0u;
        uint triangle = block + here, corner = 3u * triangle;
        if (triangle < last && mayHide(largeCorner(corner), largeCorner(corner + 1u), largeCorner(corner + 2u), box, lights))
            atomicOr(reaching[round][here / 32u], 1u << (here % 32u));
        waitForAll();
        for (uint word = 0u; word < 2u && seen; ++word) {
            uint which = reaching[round][word];
            shadeLarge(pixel, point.xyz, block + 32u * word, which);
            tested += uint(bitCount(which));
        }
        round = next;
    }
    if (seen) count(tested);
}

#else

uniform usamplerBuffer headTexels, nextTexels;  // shared/maps/pixel_lists.glsl
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
    uint entry = texelFetch(headTexels, cellIndex(whichGrid, cell)).x, tested = 0u;
    int width = textureSize(positions, 0).x, round = 0;
    for (; cell.y <= last.y && round < mostRounds; ++round) {
        if (entry != 0u) {
            ivec2 at = placeOf(entry);
            uint pixel = uint(at.y * width + at.x);
            shade(pixel, texelFetch(positions, at, 0).xyz, v0, v1, v2);
            entry = texelFetch(nextTexels, int(pixel)).x;
            ++tested;
        }
        if (entry == 0u) {
            cell = cell.x < last.x ? cell + ivec2(1, 0) : ivec2(first.x, cell.y + 1);
            if (cell.y <= last.y) entry = texelFetch(headTexels, cellIndex(whichGrid, cell)).x;
        }
    }
    if (cell.y <= last.y) handOn(v0, v1, v2);  // pixels that it has met already change no more
    count(tested);
}

#endif
