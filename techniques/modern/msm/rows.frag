// Means along rows of the powers of the map's depths.
#include "filtered/box_mean.glsl"
#include "filtered/unit_depth.glsl"
#include "moments.glsl"

out vec4 mean;

vec4 stored(ivec2 texel) {
    vec4 powers = powersOf(unitDepth(texelFetch(windowDepths, texel, 0).r));
#ifdef FORMAT_RGBA16
    return quantised(powers);
#else
    return powers;
#endif
}

void main() {
    mean = boxMean(textureSize(windowDepths, 0), ivec2(1, 0));
}
