// The weighted share of free rays over 17 pixels of a row: three masks hold them.
#include "modern/ray-classified/classes.glsl"
#include "modern/ray-classified/weights.glsl"

uniform usampler2D masks;
uniform int width;  // of the image

out float share;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint tile = classOf(pixel);
    share = tile == lit ? 1.0 : 0.0;
    if (tile != mixed) return;
    ivec2 own = pixel / ivec2(8, 4);
    uint row = 0u;  // bit 8 + x % 8 is the pixel's own
    for (int i = -1; i <= 1; ++i) {
        int column = clamp(own.x + i, 0, textureSize(masks, 0).x - 1);
        uint mask = texelFetch(masks, ivec2(column, own.y), 0).r;
        row |= ((mask >> uint(8 * (pixel.y % 4))) & 0xFFu) << uint(8 * (i + 1));
    }
    vec2 sum = vec2(0.0);
    for (int x = -radius; x <= radius; ++x) {
        if (pixel.x + x < 0 || pixel.x + x >= width) continue;
        float free = float((row >> uint(8 + pixel.x % 8 + x)) & 1u);
        sum += weightAt(abs(x)) * vec2(free, 1.0);
    }
    share = sum.x / sum.y;
}
