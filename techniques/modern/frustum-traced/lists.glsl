// The pixels in lists, one for each cell of the grids over the light's views (modern/frustum-traced/frustum-traced.cpp). A list holds
// MOST pixels; what its cell has beyond them is in lists of their own, in which pixels of all such cells stand together.
uniform int grid;  // cells per side

layout(std430, binding = 3) buffer Heads { uint heads[]; };      // per cell of all grids, then of those lists: 0, or 1 + a pixel
layout(std430, binding = 4) buffer Nexts { uint nexts[]; };      // per pixel: the next of its list, in the same way
layout(std430, binding = 5) buffer Results { uint results[]; };  // per pixel: whether the light is hidden from it
layout(std430, binding = 6) buffer Counts {
    uint beyond;    // pixels that are in no list of a cell's own
    uint counts[];  // per cell: its pixels
};

uint cellIndex(int view, ivec2 cell) {
    return uint((view * grid + cell.y) * grid + cell.x);
}
