// The irregular z-buffer: two grids over the light's view, of what lies before and behind the light, whose cells hold lists of the pixels
// that fall into them (shared/maps/pixel_lists.h).

uniform mat4 mapFromWorld;
uniform int grid;         // cells per side
uniform float nearest;    // |w| below which nothing is projected: too close to the light's plane

layout(std430, binding = 3) buffer Heads { uint heads[]; };        // per cell of both grids: 0, or the entry of the first pixel of its list
layout(std430, binding = 4) buffer Nexts { uint nexts[]; };        // per pixel: that of the next of its list, in the same way
layout(std430, binding = 5) buffer Results { uint results[]; };    // per pixel: the technique's words, 0 at first

/// A pixel of a list, above 0.
uint entryOf(ivec2 at) {
    return uint(at.y << 16 | at.x) + 1u;
}

ivec2 placeOf(uint entry) {
    return ivec2((entry - 1u) & 0xffffu, (entry - 1u) >> 16);
}

const int nowhere = -1, front = 0, back = 1;

/// The grid of a point with this w.
int gridOf(float w) {
    return w >= nearest ? front : w <= -nearest ? back : nowhere;
}

/// Position in cells of a point of the light's view, which is [0, 1]². The view fills the middle four fifths of the grid; what lies
/// beside it is squeezed into the rest. Grows with x and y, so that the box around a shape's corners holds all of the shape here too.
vec2 gridPosition(vec2 at) {
    vec2 s = 2.0 * at - 1.0;
    vec2 squeezed = mix(0.8 * s, sign(s) - 0.2 / s, greaterThan(abs(s), vec2(1.0)));
    return clamp((0.5 + 0.5 * squeezed) * float(grid), vec2(0.0), vec2(float(grid) - 0.5));
}

int cellIndex(int whichGrid, ivec2 cell) {
    return (whichGrid * grid + cell.y) * grid + cell.x;
}
