// Classes of tiles of 8 × 8 pixels, by the masks of all pixels that the three steps of the filter reach: 7 to each side.
#include "modern/ray-classified/classes.glsl"

uniform usampler2D masks;

out uint tileClass;

void main() {
    ivec2 own = ivec2(gl_FragCoord.xy) * ivec2(1, 2), last = textureSize(masks, 0) - 1;
    uint all = 0xFFFFFFFFu, any = 0u;
    for (int y = -2; y <= 3; ++y)
        for (int x = -1; x <= 1; ++x) {
            uint mask = texelFetch(masks, clamp(own + ivec2(x, y), ivec2(0), last), 0).r;
            all &= mask;
            any |= mask;
        }
    tileClass = all == 0xFFFFFFFFu ? lit : any == 0u ? shadowed : mixed;
}
