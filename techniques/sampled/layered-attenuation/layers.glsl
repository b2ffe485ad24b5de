// A layered attenuation map: for each texel of the light's view from its centre a list of the surfaces that some light sample sees there,
// and the samples that see each as bits (sampled/layered-attenuation/attenuation_map.h).
uniform int layerSide;         // texels
uniform float keysPerOctave;   // of depth

layout(std430, binding = 3) coherent buffer Heads { uint heads[]; };                      // per texel: 0, or 1 + its first layer
layout(std430, binding = 4) coherent buffer Layers { uint layerCount; uint layers[]; };   // each: the next one, its key, WORDS of bits

uint fieldsOf(uint layer) {
    return (layer - 1u) * (2u + WORDS);
}

/// Surfaces whose depths have the same key are one layer.
int depthKey(float depth) {
    return int(floor(log2(depth) * keysPerOctave));
}

/// 1 + the texel's number; 0 beside the map.
uint texelOf(vec2 at) {
    ivec2 texel = ivec2(floor(at * float(layerSide)));
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(layerSide)));
    return inside ? uint(texel.y * layerSide + texel.x) + 1u : 0u;
}
