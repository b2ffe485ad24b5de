// Means along columns of those along rows.
#include "filtered/box_mean.glsl"
#include "rounded.glsl"

uniform sampler2D rows;

out vec4 mean;

vec4 stored(ivec2 texel) {
    return texelFetch(rows, texel, 0);
}

void main() {
    mean = rounded(boxMean(textureSize(rows, 0), ivec2(0, 1)));
}
