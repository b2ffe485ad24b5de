#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2DShadow depths;
uniform sampler2D previous_mean;
uniform sampler2D previousPositions;
uniform mat4 imageFromWorld;
uniform mat4 previousImageFromWorld;
uniform int historyFrames;

out vec4 mean; // the visible share, over how many frames, and the distance along the view

/// What the frame before had of the same point; none where it saw another or nothing.
vec2 remembered(vec3 before) {
    vec4 at = previousImageFromWorld * vec4(before, 1.0);
    ivec2 pixel = ivec2(floor(at.xy / at.w));
    bool inside = at.w > 0.0 && all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, textureSize(previous_mean, 0)));
    if (historyFrames == 0 || !inside) return vec2(0.0);
    vec4 texel = texelFetch(previous_mean, pixel, 0);
    const float nearby = 0.02; // of the distance: a pixel's neighbours on a slanted plane differ, too
    return abs(texel.z - at.w) <= nearby * at.w ? texel.xy : vec2(0.0);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    mean = vec4(1.0, 0.0, -1.0, 0.0);
    if (!receiver.seen) return;
    float lit = shadowTest(depths, mapPoint(receiver.position));
    vec2 old = remembered(texelFetch(previousPositions, ivec2(gl_FragCoord.xy), 0).xyz);
    float frames = min(old.y, float(FRAMES) - 1.0) + 1.0;
    float distance = (imageFromWorld * vec4(receiver.position, 1.0)).w;
    mean = vec4(old.x + (lit - old.x) / frames, frames, distance, 0.0);
}
