// Variance of visibility: over frames, and over neighbours where there are too few of these (Schied et al. 2017, 4.2).
#include "modern/surface.glsl"

uniform sampler2D mean;
uniform sampler2D moments;

out vec2 meanAndVariance;

const float enoughFrames = 4.0;

/// First and second moment over 7 × 7 pixels of the same surface.
vec2 momentsAround(ivec2 pixel, Surface surface) {
    vec3 sum = vec3(0.0);
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x) {
            ivec2 other = pixel + ivec2(x, y);
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, textureSize(mean, 0)))) continue;
            float weight = likeness(surface, surfaceAt(other));
            sum += weight * vec3(texelFetch(moments, other, 0).xy, 1.0);
        }
    return sum.xy / sum.z;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface = surfaceAt(pixel);
    vec4 own = texelFetch(moments, pixel, 0);
    vec2 two = surface.seen && own.z < enoughFrames ? momentsAround(pixel, surface) : own.xy;
    meanAndVariance = vec2(texelFetch(mean, pixel, 0).r, max(two.y - two.x * two.x, 0.0));
}
