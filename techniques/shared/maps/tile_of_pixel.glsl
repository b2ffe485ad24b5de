// The tile that a pixel's surface point lies in.
#include "gl/receiver.glsl"

layout(std430, binding = 3) readonly buffer Table { uint tileOfCell[]; };  // tileTable() of shared/maps/tile_choice.h

uniform mat4 planeFromWorld[6];  // as in shared/maps/demand.frag, which wrote `demands`
uniform sampler2D demands;
uniform int cells;  // per side of a plane

/// The tile's number, from 0, and where the point lies: x and y in [0, 1] over the plane, depth in [0, 1]. Negative where the pixel asks
/// for none.
int tileOfPixel(out vec3 at) {
    vec4 demand = texelFetch(demands, ivec2(gl_FragCoord.xy), 0);
    if (demand.z == 0.0) return -1;
    int plane = int(demand.x);
    ivec2 cell = ivec2(vec2(demand.x - float(plane), demand.y) * float(cells));
    vec4 h = planeFromWorld[plane] * vec4(receiverAt(gl_FragCoord.xy).position, 1.0);
    at = vec3(h.xy, min(h.z, h.w)) / h.w;
    return int(tileOfCell[(plane * cells + cell.y) * cells + cell.x]) - 1;
}
