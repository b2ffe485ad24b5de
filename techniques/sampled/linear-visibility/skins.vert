// The two triangles of a skin's cell, warped into the map of the light's other end: black on the occluder, white on the receiver.
#include "sampled/linear-visibility/skins.glsl"

uniform mat4 mapFromTexel;  // of the other end, from (x · depth, y · depth, depth, 1)

noperspective out float shade;
noperspective out float inverse;  // of the depth

void main() {
    const int corners[6] = int[](0, 1, 2, 0, 2, 3);
    const ivec2 offsets[4] = ivec2[](ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 1));
    int corner = corners[gl_VertexID % 6], cell = int(skinCells[gl_VertexID / 6]), cells = side() - 1;
    ivec2 low = ivec2(cell % cells, cell / cells);
    vec4 inverses = cornersOf(low);
    float nearest = max(max(inverses.x, inverses.y), max(inverses.z, inverses.w));
    float farthest = min(min(inverses.x, inverses.y), min(inverses.z, inverses.w));
    shade = inverses[corner] > 0.5 * (nearest + farthest) ? 0.0 : 1.0;
    float depth = 1.0 / inverses[corner];
    vec2 at = (vec2(low + offsets[corner]) + 0.5) / float(side());
    vec4 h = mapFromTexel * vec4(at * depth, depth, 1.0);
    inverse = 1.0 / h.w;
    gl_Position = vec4(2.0 * h.xy - h.w, 0.0, h.w);
}
