// Puts every pixel that sees a surface into the list of its cell.
#include "gl/invocation.glsl"
#include "shared/maps/pixel_lists.glsl"

uniform sampler2D positions;
uniform int pixels;

void main() {
    uint pixel = invocation();
    if (pixel >= uint(pixels)) return;
    vec4 point = pointOf(positions, pixel);
    vec4 h = mapFromWorld * vec4(point.xyz, 1.0);
    int whichGrid = gridOf(h.w);
    if (point.w < 0.5 || whichGrid == nowhere) return;
    nexts[pixel] = atomicExchange(heads[cellIndex(whichGrid, ivec2(gridPosition(h.xy / h.w)))], pixel + 1u);
}
