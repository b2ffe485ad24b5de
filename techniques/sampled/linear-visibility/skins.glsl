// The skins of a map of linear depths: cells between four texels, by number.
uniform sampler2D linearDepth;
uniform float deepest;  // of what the map may hold: where it holds nothing, the far plane is the receiver

layout(std430, binding = 1) buffer SkinCells { uint skinCells[]; };

int side() {
    return textureSize(linearDepth, 0).x;
}

/// 1/m; linear over a plane.
float inverseDepth(ivec2 texel) {
    return 1.0 / min(abs(texelFetch(linearDepth, texel, 0).r), deepest);
}

/// The inverse depths of a cell's corners, counter-clockwise from the lowest.
vec4 cornersOf(ivec2 low) {
    return vec4(inverseDepth(low), inverseDepth(low + ivec2(1, 0)), inverseDepth(low + 1), inverseDepth(low + ivec2(0, 1)));
}
