// One frame of temporally sampled soft shadows. Beside ρ, n and depth the buffer keeps the mean blocker depth (negative: none known).
#include "sampled/shadow_buffer.glsl"
#include "shared/filters/pcss.glsl"

uniform sampler2D normals;
uniform sampler2D movingDepths;  // of the casters that move alone, as windowDepths holds those of all
uniform float lightSizeInPixels; // at unit distance from the eye
uniform vec2 neighbourTaps[NEIGHBOUR_TAPS];  // in the unit disk
uniform float threshold;
uniform float start;

/// Smoothed ψ over a disk of the penumbra's projected width (eq. 4.6) around where the last frame had the point, over those of the first
/// `taps` neighbours that had the same depth there.
float neighbourhoodFilter(Remembered old, float own, float lightDepth, float blockerDepth, int taps) {
    float penumbra = lightSizeInPixels / old.depth * (lightDepth - blockerDepth) / blockerDepth;
    vec2 radius = 0.5 * penumbra / vec2(textureSize(shadowBuffer, 0));
    float sum = own;
    float taken = 1.0;
    for (int i = 0; i < taps; ++i) {
        vec4 neighbour = texture(shadowBuffer, old.at + neighbourTaps[min(i, NEIGHBOUR_TAPS - 1)] * radius);
        if (neighbour.y < 0.5 || !sameDepth(old.depth, neighbour.z)) continue;
        sum += neighbour.x / neighbour.y;
        taken += 1.0;
    }
    return sum / taken;
}

void main() {
    Receiver receiver = receiverAt(vec2(ownPixel()));
    if (!receiver.seen) {
        showBackground();
        return;
    }
    vec3 normal = normalize(texelFetch(normals, ownPixel(), 0).xyz);
    LightReceiver r = lightReceiver(receiver.position, normal);
    float depth = depthFromEye(receiver);

    // The hard test against this frame's sample of the light.
    float mapDepth = linearDepthAt(r.at);
    float tau = !r.behind && mapDepth < r.depth ? 1.0 : 0.0;
    bool movingShadow = tau == 1.0 && texture(movingDepths, r.at).r <= texture(windowDepths, r.at).r;

    Remembered old = remembered();
    bool anew = !old.known || movingShadow;

    // New, or under a moving shadow: PCSS, which counts for `start` samples. What most pixels do without is a loop whose length is 0 for
    // them: a software rasteriser runs both sides of an `if`, but leaves a loop as soon as none of its pixels is in it.
    float startBlocker = averageBlockerDepth(r, anew && !r.behind ? SEARCH_TAPS : 0);
    float startVisibility = pcssVisibility(r, startBlocker, startBlocker > 0.0 && start > 0.0 ? FILTER_TAPS : 0);

    vec2 counts;
    float psi, blocker;
    bool smoothed;
    if (anew) {
        float n = max(start, 1.0);
        psi = start > 0.0 ? 1.0 - startVisibility : tau;
        counts = vec2(psi * n, n);
        blocker = startBlocker;
        smoothed = movingShadow && old.inside;
    } else {
        counts = withSample(old.values.xy, tau);
        blocker = old.values.w;
        if (tau == 1.0)
            blocker = blocker > 0.0 ? blockerUpdate(blocker, mapDepth, counts.y, float(SEARCH_TAPS)) : mapDepth;
        psi = occlusionEstimate(counts.x, counts.y);
        smoothed = sqrt(occlusionVariance(psi, counts.y)) >= threshold;
    }
    newShadowBuffer = toHalf(vec4(counts, depth, blocker));
    int neighbours = smoothed && blocker > 0.0 ? NEIGHBOUR_TAPS : 0;
    visibility = 1.0 - neighbourhoodFilter(old, psi, r.depth, blocker, neighbours);
}
