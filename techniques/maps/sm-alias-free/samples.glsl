// The irregular z-buffer: two grids over the light's view, of what lies before and behind the light, whose cells hold lists of the pixels
// that fall into them.
uniform mat4 mapFromWorld;
uniform int grid;         // cells per side
uniform float nearest;    // |w| below which nothing is projected: too close to the light's plane

layout(std430, binding = 3) buffer Heads { uint heads[]; };        // per cell of both grids: 0, or 1 + the first pixel of its list
layout(std430, binding = 4) buffer Nexts { uint nexts[]; };        // per pixel: the next of its list, in the same way
layout(std430, binding = 5) buffer Shadows { uint shadows[]; };    // per pixel: 1 where some triangle hides the light

const int nowhere = -1, front = 0, back = 1;

/// The grid of a point with this w.
int gridOf(float w) {
    return w >= nearest ? front : w <= -nearest ? back : nowhere;
}

/// Position in cells. The light's view fills the middle four fifths of the grid; what lies beside it is squeezed into the rest. Grows
/// with x and y, so that the box around a triangle's corners holds every point of the triangle here too.
vec2 gridPosition(vec4 h) {
    vec2 s = 2.0 * h.xy / h.w - 1.0;
    vec2 squeezed = mix(0.8 * s, sign(s) - 0.2 / s, greaterThan(abs(s), vec2(1.0)));
    return clamp((0.5 + 0.5 * squeezed) * float(grid), vec2(0.0), vec2(float(grid) - 0.5));
}

int cellIndex(int whichGrid, ivec2 cell) {
    return (whichGrid * grid + cell.y) * grid + cell.x;
}

/// The surface point that a pixel sees; w = 0 for background.
vec4 pointOf(sampler2D positions, uint pixel) {
    int width = textureSize(positions, 0).x;
    return texelFetch(positions, ivec2(int(pixel) % width, int(pixel) / width), 0);
}
