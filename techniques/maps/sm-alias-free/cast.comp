// Whether a triangle hides the light from a pixel.
#include "shared/maps/hides.glsl"
#include "shared/maps/large_triangles.glsl"
#include "shared/maps/pixel_lists.glsl"

uniform vec4 light;
uniform float slack;

const int roundsOfShade = 0;

void shade(uint pixel, vec3 point, vec3 v0, vec3 v1, vec3 v2) {
    if (results[pixel] == 0u && hides(v0, v1, v2, point, light, slack)) results[pixel] = 1u;
}

uint shadeLarge(uint pixel, vec3 point, uint first, uint last) {
    uint triangle = first;
    while (triangle < last) {
        uint corner = 3u * triangle++;
        shade(pixel, point, largeCorner(corner), largeCorner(corner + 1u), largeCorner(corner + 2u));
        if (results[pixel] != 0u) break;
    }
    return triangle - first;
}

#include "shared/maps/cast_triangles.glsl"
