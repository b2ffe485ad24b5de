// Means over frames of visibility and of its first two moments (Schied et al. 2017, 4.1 and 4.2).
#include "modern/surface.glsl"

uniform sampler2D noisy;
uniform sampler2D previousPositions;
uniform sampler2D previousMean;
uniform sampler2D previousMoments;
uniform mat4 previousClipFromWorld;
uniform int hasHistory;

layout(location = 0) out float mean;
layout(location = 1) out vec4 moments;  // first and second, frames, metres along the view; no frames: nothing is seen

struct History {
    float mean;
    vec3 moments;  // and frames
};

/// Of the four pixels around the place where the frame before had the point, those that saw it.
History historyOf(vec3 before) {
    History sum = History(0.0, vec3(0.0));
    vec4 h = previousClipFromWorld * vec4(before, 1.0);
    ivec2 size = textureSize(noisy, 0);
    vec2 at = (0.5 * h.xy / h.w + 0.5) * vec2(size) - 0.5;
    float weights = 0.0;
    for (int i = 0; i < 4 && hasHistory == 1 && h.w > 0.0; ++i) {
        ivec2 pixel = ivec2(floor(at)) + ivec2(i & 1, i >> 1);
        if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) continue;
        vec4 then = texelFetch(previousMoments, pixel, 0);
        if (then.z < 0.5 || abs(then.w - h.w) > 0.02 * h.w) continue;
        vec2 near = 1.0 - abs(vec2(pixel) - at);
        float weight = near.x * near.y;
        sum.mean += weight * texelFetch(previousMean, pixel, 0).r;
        sum.moments += weight * then.xyz;
        weights += weight;
    }
    return weights > 0.01 ? History(sum.mean / weights, sum.moments / weights) : History(0.0, vec3(0.0));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface = surfaceAt(pixel);
    mean = 1.0;
    moments = vec4(0.0);
    if (!surface.seen) return;
    float now = texelFetch(noisy, pixel, 0).r;
    History old = historyOf(texelFetch(previousPositions, pixel, 0).xyz);
    float frames = old.moments.z + 1.0;
    float share = max(1.0 / frames, SHARE);
    mean = mix(old.mean, now, share);
    moments = vec4(mix(old.moments.xy, vec2(now, now * now), share), frames, surface.depth);
}
