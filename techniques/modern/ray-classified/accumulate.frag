// Means over frames: where the frame before saw the point, what it had there, clamped to what rays of this frame have around it.
#include "modern/ray-classified/classes.glsl"
#include "modern/ray-classified/weights.glsl"
#include "modern/surface.glsl"

uniform sampler2D noisy;
uniform sampler2D rows;
uniform sampler2D previousPositions;
uniform sampler2D previousMean;
uniform sampler2D previousMoments;
uniform mat4 previousClipFromWorld;
uniform vec3 eye;
uniform int hasHistory;

layout(location = 0) out vec2 meanAndVariance;
layout(location = 1) out vec4 moments;  // mean, sum of squared deviations, frames, metres along the view; no frames: nothing is seen

/// The weighted share of free rays over 17 × 17 pixels.
float shareAround(ivec2 pixel) {
    vec2 sum = vec2(0.0);
    for (int y = -radius; y <= radius; ++y) {
        ivec2 other = pixel + ivec2(0, y);
        if (other.y < 0 || other.y >= textureSize(rows, 0).y) continue;
        sum += weightAt(abs(y)) * vec2(texelFetch(rows, other, 0).r, 1.0);
    }
    return sum.x / sum.y;
}

/// Where the frame before had the point: place in [0, 1]², and metres along the view.
vec3 placeBefore(ivec2 pixel) {
    vec4 h = previousClipFromWorld * vec4(texelFetch(previousPositions, pixel, 0).xyz, 1.0);
    return vec3(0.5 * h.xy / h.w + 0.5, h.w);
}

/// Moments of the frame before; none where it saw another surface there. At grazing angles depths within a pixel differ more.
vec3 momentsBefore(vec3 before, Surface surface) {
    bool beside = any(lessThan(before.xy, vec2(0.0))) || any(greaterThanEqual(before.xy, vec2(1.0)));
    if (hasHistory == 0 || before.z <= 0.0 || beside) return vec3(0.0);
    vec4 then = texelFetch(previousMoments, ivec2(before.xy * vec2(textureSize(previousMoments, 0))), 0);
    float grazing = pow(1.0 - abs(dot(normalize(eye - surface.position), surface.normal)), 8.0);
    return then.z > 0.0 && abs(then.w - before.z) < mix(0.01, 0.1, grazing) * before.z ? then.xyz : vec3(0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface = surfaceAt(pixel);
    uint tile = classOf(pixel);
    float now = texelFetch(noisy, pixel, 0).r;
    meanAndVariance = vec2(tile == shadowed ? 0.0 : 1.0, 0.0);
    moments = vec4(meanAndVariance, surface.seen ? 1.0 : 0.0, surface.depth);
    if (!surface.seen || tile != mixed) return;

    // Welford's running mean and sum.
    vec3 before = placeBefore(pixel), old = momentsBefore(before, surface);
    float frames = old.z + 1.0;
    float average = mix(old.x, now, 1.0 / frames);
    float squares = old.y + (now - old.x) * (now - average);
    float variance = frames > 1.0 ? squares / (frames - 1.0) : 1.0;

    float around = shareAround(pixel);
    float varianceAround = max(around - around * around, 0.0);  // of zeros and ones
    float reach = 0.5 * sqrt(varianceAround);
    float history = hasHistory == 1 && before.z > 0.0 ? texture(previousMean, before.xy).r : now;
    float jump = (history - around) / max(reach, 0.001);
    frames *= exp(-jump * jump / 20.0);  // what moved over the point makes its history young again
    if (frames < 16.0) variance = max(variance, varianceAround) * max(16.0 - frames, 1.0);
    float share = mix(SHARE, 1.0, sqrt(max(8.0 - frames, 0.0) / 8.0));
    meanAndVariance = vec2(mix(clamp(history, around - reach, around + reach), now, share), variance);
    moments = vec4(average, squares, frames, surface.depth);
}
