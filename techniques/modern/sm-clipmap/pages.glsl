// Where a point lies in levels of pages (modern/sm-clipmap/clipmap.h, which sets the uniforms).
#include "shared/maps/cube_side.glsl"

uniform int planes;               // 1, or the six sides of a cube around the light
uniform vec3 light;               // its centre, where there are six
uniform mat4 finestFromWorld[6];  // x and y in pages of the finest level, depth in [0, 1]
uniform vec4 texelFromWorld[6];   // dot with (p, 1): metres along a texel of the finest level
uniform vec4 pixelFromWorld;      // dot with (p, 1): metres along what a texel must not be longer than
uniform vec4 windows[LEVELS];     // of each level: first column and row, and pages along a side
uniform int levels;
uniform int side;                 // of a window in tables
uniform vec2 ends;                // of x and y

struct Place {
    int plane;
    vec3 at;
    int level;  // that it asks for, from 0 for the finest
};

/// The entry in tables of the page that holds the place at a level; negative where the window does not.
int entryOf(Place place, int level) {
    vec3 window = windows[level].xyz;
    ivec2 page = ivec2(floor(place.at.xy / float(1 << level)) - window.xy);
    if (min(page.x, page.y) < 0 || max(page.x, page.y) >= int(window.z)) return -1;
    return ((place.plane * levels + level) * side + page.y) * side + page.x;
}

/// The level is the coarsest with texels as short as asked for whose window holds the point, or else the finest that does.
Place placeOf(vec3 world) {
    vec4 p = vec4(world, 1.0);
    int plane = planes == 1 ? 0 : sideOf(world - light);
    vec4 h = finestFromWorld[plane] * p;
    Place place = Place(plane, vec3(clamp(h.xy / h.w, ends.x, ends.y), min(h.z, h.w) / h.w), 0);
    float coarser = log2(dot(pixelFromWorld, p) / dot(texelFromWorld[plane], p));
    place.level = int(clamp(floor(coarser), 0.0, float(levels - 1)));
    while (place.level < levels - 1 && entryOf(place, place.level) < 0) ++place.level;
    return place;
}
