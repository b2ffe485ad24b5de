// Means along rows of the moments of the map's depths.
#include "filtered/box_mean.glsl"
#include "filtered/unit_depth.glsl"
#include "rounded.glsl"
#include "warp.glsl"

out vec4 mean;

vec4 stored(ivec2 texel) {
    return momentsOf(unitDepth(texelFetch(windowDepths, texel, 0).r));
}

void main() {
    mean = rounded(boxMean(textureSize(windowDepths, 0), ivec2(1, 0)));
}
