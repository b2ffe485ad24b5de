// The shadow test of the pixels that lie in one of the tiles in the atlas; the others keep what they have.
#include "gl/receiver.glsl"

layout(std430, binding = 3) readonly buffer Table { uint tileOfCell[]; };  // tileTable() of shared/maps/tile_choice.h
layout(std430, binding = 4) readonly buffer Places { vec4 places[]; };     // two a tile: from plane to atlas (offset, scale), texel centres

uniform mat4 planeFromWorld[6];  // as in shared/maps/demand.frag, which wrote `demands`
uniform sampler2D demands;
uniform sampler2DShadow depthAtlas;
uniform int cells;  // per side of a plane
uniform int firstTile;
uniform int tilesDrawn;

out float visibility;

void main() {
    vec4 demand = texelFetch(demands, ivec2(gl_FragCoord.xy), 0);
    if (demand.z == 0.0) discard;
    int plane = int(demand.x);
    ivec2 cell = ivec2(vec2(demand.x - float(plane), demand.y) * float(cells));
    int tile = int(tileOfCell[(plane * cells + cell.y) * cells + cell.x]) - 1;
    if (tile < firstTile || tile >= firstTile + tilesDrawn) discard;

    vec4 h = planeFromWorld[plane] * vec4(receiverAt(gl_FragCoord.xy).position, 1.0);
    vec4 place = places[2 * tile], inner = places[2 * tile + 1];
    vec2 at = clamp(place.xy + place.zw * (h.xy / h.w), inner.xy, inner.zw);
    visibility = texture(depthAtlas, vec3(at, min(h.z / h.w, 1.0)));
}
