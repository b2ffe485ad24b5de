// One frame of temporally sampled soft shadows. Beside ρ, n and depth the buffer keeps the mean blocker depth (negative: none known).
#include "sampled/shadow_buffer.glsl"
#include "shared/filters/pcss.glsl"

uniform sampler2D normals;
uniform float lightSizeInPixels; // at unit distance from the eye
uniform vec2 neighbourTaps[NEIGHBOUR_TAPS];  // in the unit disk
uniform float threshold;
uniform float start;

/// Smoothed ψ over a disk of the penumbra's projected width (eq. 4.6) around `at`, over neighbours of the same depth.
float neighbourhoodFilter(vec2 at, float own, float depth, float lightDepth, float blockerDepth) {
    float penumbra = lightSizeInPixels / depth * (lightDepth - blockerDepth) / blockerDepth;
    vec2 radius = 0.5 * penumbra / vec2(textureSize(shadowBuffer, 0));
    float sum = own;
    float taken = 1.0;
    for (int i = 0; i < NEIGHBOUR_TAPS; ++i) {
        vec4 neighbour = texture(shadowBuffer, at + neighbourTaps[i] * radius);
        if (neighbour.y < 0.5 || !sameDepth(depth, neighbour.z)) continue;
        sum += neighbour.x / neighbour.y;
        taken += 1.0;
    }
    return sum / taken;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    if (!receiver.seen) {
        showBackground();
        return;
    }
    vec3 normal = normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    LightReceiver r = lightReceiver(receiver.position, normal);
    float depth = depthFromEye(receiver);

    // The hard test against this frame's sample of the light.
    float mapDepth = texture(linearDepth, r.at).r;
    float tau = !r.behind && abs(mapDepth) < r.depth ? 1.0 : 0.0;
    bool movingShadow = tau == 1.0 && mapDepth < 0.0;

    Remembered old = remembered();
    if (old.known && !movingShadow) {
        vec2 counts = withSample(old.values.xy, tau);
        float n = counts.y;
        float blocker = old.values.w;
        if (tau == 1.0)
            blocker = blocker > 0.0 ? blockerUpdate(blocker, abs(mapDepth), n, float(SEARCH_TAPS)) : abs(mapDepth);
        newShadowBuffer = toHalf(vec4(counts, depth, blocker));

        float psi = occlusionEstimate(counts.x, n);
        float standardError = sqrt(occlusionVariance(psi, n));
        if (standardError >= threshold && blocker > 0.0) psi = neighbourhoodFilter(old.at, psi, depth, r.depth, blocker);
        visibility = 1.0 - psi;
        return;
    }

    // New, or under a moving shadow: PCSS, which counts for `start` samples.
    float blocker = r.behind ? -1.0 : averageBlockerDepth(r);
    float psi = start > 0.0 ? 1.0 - pcssVisibility(r, blocker) : tau;
    float n = max(start, 1.0);
    newShadowBuffer = toHalf(vec4(psi * n, n, depth, blocker));
    if (movingShadow && old.inside && blocker > 0.0) psi = neighbourhoodFilter(old.at, psi, depth, r.depth, blocker);
    visibility = 1.0 - psi;
}
