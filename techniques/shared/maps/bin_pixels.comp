// Puts every pixel that sees a surface into the list of its cell.
#include "gl/invocation.glsl"
#include "shared/maps/pixel_lists.glsl"

uniform sampler2D positions;

void main() {
    ivec2 size = textureSize(positions, 0);
    int pixel = int(invocation());
    if (pixel >= size.x * size.y) return;
    ivec2 at = ivec2(pixel % size.x, pixel / size.x);
    vec4 point = texelFetch(positions, at, 0);
    vec4 h = mapFromWorld * vec4(point.xyz, 1.0);
    int whichGrid = gridOf(h.w);
    if (point.w < 0.5 || whichGrid == nowhere) return;
    nexts[pixel] = atomicExchange(heads[cellIndex(whichGrid, ivec2(gridPosition(h.xy / h.w)))], entryOf(at));
}
