// The outlines of casters: texels that stand out from the plane through their neighbours, towards the light. 1 / depth is linear on
// planes, so that slanted ones have none.
uniform sampler2D linearDepth;  // negative: moving caster
uniform float leastStep;        // share of the depth behind

out vec2 skirt;  // attenuation, 1 / depth

float inverseDepth(ivec2 texel) {
    return 1.0 / abs(texelFetch(linearDepth, clamp(texel, ivec2(0), textureSize(linearDepth, 0) - 1), 0).r);
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float own = inverseDepth(texel);
    float alongX = 2.0 * own - inverseDepth(texel - ivec2(1, 0)) - inverseDepth(texel + ivec2(1, 0));
    float alongY = 2.0 * own - inverseDepth(texel - ivec2(0, 1)) - inverseDepth(texel + ivec2(0, 1));
    skirt = max(alongX, alongY) > leastStep * own ? vec2(1.0, own) : vec2(0.0);
}
