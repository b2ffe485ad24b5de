// One frame of temporally sampled soft shadows. ψ is the occluded fraction; the output is 1 − ψ.
#include "gl/half.glsl"
#include "gl/receiver.glsl"
#include "sampled/temporal-soft/estimators.glsl"
#include "shared/filters/pcss.glsl"

uniform sampler2D normals;
uniform sampler2D previousPositions;
uniform sampler2D shadowBuffer;  // ρ, n, linear eye depth, mean blocker depth (negative: none known)
uniform mat4 previousClipFromWorld;
uniform vec4 eyeDepth;           // dot(·, (p, 1)) = linear depth from the eye
uniform vec4 previousEyeDepth;
uniform float lightSizeInPixels; // at unit distance from the eye
uniform vec2 neighbourTaps[NEIGHBOUR_TAPS];  // in the unit disk
uniform float threshold;
uniform float epsilon;
uniform float start;
uniform int hasHistory;

layout(location = 0) out float visibility;
layout(location = 1) out vec4 newShadowBuffer;

bool sameDepth(float now, float before) {  // eq. 4.8
    return abs(1.0 - now / before) < epsilon;
}

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
        visibility = 1.0;
        newShadowBuffer = vec4(0.0);
        return;
    }
    vec3 normal = normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    LightReceiver r = lightReceiver(receiver.position, normal);
    float depth = dot(eyeDepth, vec4(receiver.position, 1.0));

    // The hard test against this frame's sample of the light.
    float mapDepth = texture(linearDepth, r.at).r;
    float tau = !r.behind && abs(mapDepth) < r.depth ? 1.0 : 0.0;
    bool movingShadow = tau == 1.0 && mapDepth < 0.0;

    vec3 before = texelFetch(previousPositions, ivec2(gl_FragCoord.xy), 0).xyz;
    vec4 h = previousClipFromWorld * vec4(before, 1.0);
    vec2 at = h.xy / h.w * 0.5 + 0.5;
    bool inside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0)));
    vec4 old = texture(shadowBuffer, at);
    bool known = hasHistory == 1 && inside && old.y > 0.5 && sameDepth(dot(previousEyeDepth, vec4(before, 1.0)), old.z);

    if (known && !movingShadow) {
        vec2 counts = withSample(old.xy, tau);
        float n = counts.y;
        float blocker = old.w;
        if (tau == 1.0)
            blocker = old.w > 0.0 ? blockerUpdate(old.w, abs(mapDepth), n, float(SEARCH_TAPS)) : abs(mapDepth);
        newShadowBuffer = toHalf(vec4(counts, depth, blocker));

        float psi = occlusionEstimate(counts.x, n);
        float standardError = sqrt(occlusionVariance(psi, n));
        if (standardError >= threshold && blocker > 0.0) psi = neighbourhoodFilter(at, psi, depth, r.depth, blocker);
        visibility = 1.0 - psi;
        return;
    }

    // New, or under a moving shadow: PCSS, which counts for `start` samples.
    float blocker = r.behind ? -1.0 : averageBlockerDepth(r);
    float psi = start > 0.0 ? 1.0 - pcssVisibility(r, blocker) : tau;
    float n = max(start, 1.0);
    newShadowBuffer = toHalf(vec4(psi * n, n, depth, blocker));
    if (movingShadow && hasHistory == 1 && inside && blocker > 0.0) psi = neighbourhoodFilter(at, psi, depth, r.depth, blocker);
    visibility = 1.0 - psi;
}
