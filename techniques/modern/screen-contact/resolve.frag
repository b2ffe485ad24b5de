#include "shared/maps/tested_point.glsl"
#include "shared/sampling/vogel.glsl"

uniform sampler2DShadow depths;
uniform mat4 imageFromWorld;
uniform vec4 lightPlace;
uniform int seed;

out float visibility;

/// The ray from `from` towards the light: LENGTH metres, or up to a light that is nearer.
vec3 contactRay(vec3 from) {
    vec3 towards = lightPlace.xyz - lightPlace.w * from;
    float distance = length(towards);
    return towards / distance * (lightPlace.w > 0.0 ? min(distance, LENGTH) : LENGTH);
}

/// Whether a point lies behind the surface that a pixel shows, and no deeper than all is taken to be.
bool behindSurface(vec3 point, float depth, vec2 pixel) {
    Receiver shown = receiverAt(pixel);
    if (!shown.seen || dot(normalAt(pixel), point - shown.position) >= 0.0) return false;
    return depth - (imageFromWorld * vec4(shown.position, 1.0)).w < THICKNESS;
}

/// Steps are moved by up to one, each pixel's by its own share, so that the gaps between them are noise instead of bands.
bool blockedOnScreen(vec3 from, float share) {
    vec3 ray = contactRay(from);
    vec2 size = vec2(textureSize(positions, 0));
    for (int i = 0; i < STEPS; ++i) {
        vec3 point = from + ray * ((float(i) + 1.0 - share) / float(STEPS));
        vec4 h = imageFromWorld * vec4(point, 1.0);
        vec2 pixel = floor(h.xy / h.w);
        if (h.w <= 0.0 || any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, size))) return false;
        if (pixel != floor(gl_FragCoord.xy) && behindSurface(point, h.w, pixel)) return true;
    }
    return false;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    visibility = shadowTest(depths, testedPoint(receiver));
    if (visibility > 0.0 && blockedOnScreen(receiver.position, gradientNoise(gl_FragCoord.xy, 0, seed))) visibility = 0.0;
}
