// Depth and alpha of a smoothie (course, "Computing Alpha").
#include "shared/maps/linearised_map.glsl"

in float depth;
noperspective in float acrossImage;

out vec2 smoothie;

void main() {
    float receiver = linearDepth(texelFetch(windowDepths, ivec2(gl_FragCoord.xy), 0).r);
    if (depth >= receiver) discard;
    smoothie = vec2(depth, acrossImage / (1.0 - depth / receiver));
}
