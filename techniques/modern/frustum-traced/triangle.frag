// Tests a triangle against the pixels of a cell that it touches.
#include "modern/frustum-traced/lists.glsl"
#include "shared/maps/hides.glsl"
#include "shared/maps/pixel_point.glsl"

layout(early_fragment_tests) in;

uniform sampler2D positions;
uniform float cell;
uniform int view;
uniform int views;
uniform int part;  // 0: the cell's own list; else one of those for what cells have beyond theirs
uniform vec4 light;
uniform float slack;

flat in vec3 v0, v1, v2;
flat in vec3 side0, side1, side2;

#ifdef COUNT_TESTS
layout(std430, binding = 7) buffer Tests { uint tests; };
#endif

/// How far from a triangle a point that lies on it may seem to be: positions and products are rounded in parts of the longest vector.
float slackAt(vec3 point) {
    vec3 a = v0 - point, b = v1 - point, c = v2 - point;
    return slack * sqrt(max(max(dot(a, a), dot(b, b)), max(dot(c, c), dot(point, point))));
}

void main() {
    vec3 at = vec3(gl_FragCoord.xy * cell, 1.0);
    if (min(min(dot(side0, at), dot(side1, at)), dot(side2, at)) < 0.0) return;
    uint here = cellIndex(view, ivec2(gl_FragCoord.xy));
    if (part > 0 && counts[here] <= MOST) return;
    uint tested = 0u;
    for (uint entry = heads[part == 0 ? here : uint(views * grid * grid + part - 1)]; entry != 0u; ++tested) {
        uint pixel = entry - 1u;
        entry = nexts[pixel];
        if (results[pixel] != 0u) continue;
        vec3 point = pointOf(positions, pixel).xyz;
        if (hides(v0, v1, v2, point, light, slackAt(point))) results[pixel] = 1u;
    }
#ifdef COUNT_TESTS
    atomicAdd(tests, tested);
#endif
}
