// Puts every pixel that sees a surface into the list of its cell.
#include "gl/invocation.glsl"
#include "modern/frustum-traced/lists.glsl"
#include "shared/maps/pixel_point.glsl"

uniform sampler2D positions;
uniform int pixels;
uniform int views;
uniform mat4 mapFromWorld[6];

void main() {
    uint pixel = invocation();
    if (pixel >= uint(pixels)) return;
    vec4 point = pointOf(positions, pixel);
    if (point.w < 0.5) return;
    for (int view = 0; view < views; ++view) {
        vec4 h = mapFromWorld[view] * vec4(point.xyz, 1.0);
        vec2 at = h.xy / h.w;
        if (h.w <= 0.0 || at != clamp(at, 0.0, 1.0)) continue;
        uint cell = cellIndex(view, min(ivec2(at * float(grid)), grid - 1));
        uint list = atomicAdd(counts[cell], 1u) < MOST ? cell : uint(views * grid * grid) + atomicAdd(beyond, 1u) / MOST;
        nexts[pixel] = atomicExchange(heads[list], pixel + 1u);
        return;
    }
}
