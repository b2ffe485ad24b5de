// The visible share of the light between two ends, each with its shadow map and its visibility map (course, "New shadow map algorithm").
#include "gl/receiver.glsl"

uniform sampler2D normals;
uniform mat4 mapsFromWorld[2];
uniform mat4 worldFromTexels[2];  // from (x · depth, y · depth, depth, 1)
uniform float leastGap;           // of two inverse depths: their penumbra is as wide as a texel
uniform sampler2D depths0;
uniform sampler2D depths1;
uniform sampler2D visibilities0;
uniform sampler2D visibilities1;

out float visibility;

/// Bilinear over the texels that a skin covers; more than 1 where none covers the point's own.
float skinAt(sampler2D visibilities, vec2 at) {
    float own = texture(visibilities, at).r;
    vec4 four = textureGather(visibilities, at);
    vec2 f = fract(at * vec2(textureSize(visibilities, 0)) - 0.5);
    vec4 weights = vec4((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y));
    weights = mix(weights, vec4(0.0), greaterThan(four, vec4(1.0)));
    return own > 1.0 ? own : dot(weights, min(four, 1.0)) / (weights.x + weights.y + weights.z + weights.w);
}

/// Inverse depth of the receiver's plane in the middle of the texel that it falls into.
float planeInverse(mat4 worldFromTexel, vec3 world, vec3 normal, vec2 at, float side) {
    vec3 ray = (worldFromTexel * vec4((floor(at * side) + 0.5) / side, 1.0, 0.0)).xyz;
    return dot(normal, ray) / dot(normal, world - worldFromTexel[3].xyz);
}

float seenFrom(int end, sampler2D depths, sampler2D visibilities, vec3 world, vec3 normal) {
    const float completelyLit = 0.5;
    vec4 h = mapsFromWorld[end] * vec4(world, 1.0);
    if (h.w <= 0.0) return completelyLit;
    vec2 at = h.xy / h.w;
    float inverse = planeInverse(worldFromTexels[end], world, normal, at, float(textureSize(depths, 0).x));
    inverse = clamp(inverse, 0.5 / h.w, 2.0 / h.w);  // seen edge-on
    float seen = 1.0 / abs(texture(depths, at).r);
    if (inverse < seen - 0.5 * leastGap) return 0.0;
    if (inverse > seen + leastGap) return completelyLit;  // a rim: the skins of this texel lie on what is behind it
    float share = skinAt(visibilities, at);
    return share > 1.0 ? completelyLit : share;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    vec3 normal = texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz;
    float sum = seenFrom(0, depths0, visibilities0, receiver.position, normal) +
                seenFrom(1, depths1, visibilities1, receiver.position, normal);
    visibility = receiver.seen ? min(sum, 1.0) : 1.0;
}
