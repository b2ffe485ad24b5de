// The shadow test in the page that holds the pixel's surface point. Pixels whose page is not there keep what they have.
#include "shared/maps/tile_of_pixel.glsl"

/// A page's place in its plane, and that of its map.
struct Place {
    ivec2 page;         // column and row
    ivec2 corner;       // first texel in `depths`; negative: it is not there
    int pagesPerPlane;  // along a side, at the page's level
};
layout(std430, binding = 4) readonly buffer Places { Place places[]; };

uniform sampler2D depths;
uniform int texels;  // per side of a page

out float visibility;

void main() {
    vec3 point;
    int number = tileOfPixel(point);
    if (number < 0) discard;
    Place place = places[number];
    if (place.corner.x < 0) discard;
    vec2 inPage = point.xy * float(place.pagesPerPlane) - vec2(place.page);
    ivec2 texel = clamp(ivec2(floor(inPage * float(texels))), 0, texels - 1);
    visibility = point.z <= texelFetch(depths, place.corner + texel, 0).r ? 1.0 : 0.0;
}
