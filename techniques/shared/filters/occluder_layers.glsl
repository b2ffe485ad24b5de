// The share of a light that a layer of occluders hides (shared/filters/occluder_layers.h).
#include "shared/filters/summed_areas.glsl"

uniform vec2 lightTexels;  // half the light's width and height in the map, in texels, per 1/b − 1/r

/// Set texels of a layer in the rectangle between two corners.
float texelsBetween(int layer, ivec2 low, ivec2 high) {
    return float(areas[sumIndex(layer, high)] - areas[sumIndex(layer, ivec2(low.x, high.y))] -
                 areas[sumIndex(layer, ivec2(high.x, low.y))] + areas[sumIndex(layer, low)]);
}

/// The same up to any point beyond the corner `low`; texels are squares that are set all over.
float texelsUpTo(int layer, ivec2 low, vec2 high) {
    ivec2 corner = min(ivec2(high), ivec2(side - 1));
    vec2 part = high - vec2(corner);
    float below = mix(texelsBetween(layer, low, corner), texelsBetween(layer, low, corner + ivec2(1, 0)), part.x);
    float above = mix(texelsBetween(layer, low, corner + ivec2(0, 1)), texelsBetween(layer, low, corner + 1), part.x);
    return mix(below, above, part.y);
}

/// The mean of a layer over the light's image around a point of the map, as cast by an occluder whose penumbra reaches `reach`
/// = 1/b − 1/r from its hard edge. Nothing occludes beside the map. A point light is a texel wide.
float occlusion(int layer, vec2 at, float reach) {
    vec2 middle = at * float(side), halfSize = max(reach * lightTexels, 0.5);
    vec2 low = clamp(middle - halfSize, 0.0, float(side)), high = clamp(middle + halfSize, 0.0, float(side));
    ivec2 from = ivec2(low);
    float texels = texelsUpTo(layer, from, high) - texelsUpTo(layer, from, vec2(low.x, high.y)) -
                   texelsUpTo(layer, from, vec2(high.x, low.y)) + texelsUpTo(layer, from, low);
    return clamp(texels / (4.0 * halfSize.x * halfSize.y), 0.0, 1.0);
}
