// Tests every pixel against the large triangles.
#include "gl/invocation.glsl"
#include "maps/sm-alias-free/hides.glsl"
#include "maps/sm-alias-free/large.glsl"
#include "maps/sm-alias-free/samples.glsl"

uniform sampler2D positions;
uniform int pixels;
uniform vec4 light;
uniform float slack;

void main() {
    uint pixel = invocation();
    if (pixel >= uint(pixels) || shadows[pixel] != 0u) return;
    vec4 point = pointOf(positions, pixel);
    if (point.w < 0.5) return;
    for (uint i = 0u; i < largeCount; ++i)
        if (hides(largeCorners[3u * i].xyz, largeCorners[3u * i + 1u].xyz, largeCorners[3u * i + 2u].xyz, point.xyz, light, slack)) {
            shadows[pixel] = 1u;
            return;
        }
}
