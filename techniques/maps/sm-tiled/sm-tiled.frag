// The shadow test in the tile that holds the pixel's surface point; pixels that lie in none keep what they have.
#include "shared/maps/tile_of_pixel.glsl"

layout(std430, binding = 4) readonly buffer Places { vec4 places[]; };  // two a tile: from plane to atlas (offset, scale), texel centres

uniform sampler2DShadow depthAtlas;

out float visibility;

void main() {
    vec3 point;
    int tile = tileOfPixel(point);
    if (tile < 0) discard;
    vec4 place = places[2 * tile], inner = places[2 * tile + 1];
    vec2 at = clamp(place.xy + place.zw * point.xy, inner.xy, inner.zw);
    visibility = texture(depthAtlas, vec3(at, point.z));
}
