// Whether a triangle hides the light from a pixel.
#include "shared/maps/hides.glsl"
#include "shared/maps/large_triangles.glsl"
#include "shared/maps/pixel_lists.glsl"

uniform vec4 light;
uniform float slack;

const int roundsOfShade = 0;

void shade(uint pixel, vec3 point, vec3 v0, vec3 v1, vec3 v2) {
    if (hides(v0, v1, v2, point, light, slack)) results[pixel] = 1u;
}

void shadeLarge(uint pixel, vec3 point, uint first, uint which) {
    bool hidden = false;
    for (; which != 0u && !hidden; which &= which - 1u) {
        uint corner = 3u * (first + uint(findLSB(which)));
        hidden = hides(largeCorner(corner), largeCorner(corner + 1u), largeCorner(corner + 2u), point, light, slack);
    }
    if (hidden) results[pixel] = 1u;
}

#include "shared/maps/cast_triangles.glsl"
