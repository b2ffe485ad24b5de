// Warps what one light sample sees into the lists of the layered attenuation map.
#include "gl/invocation.glsl"
#include "sampled/layered-attenuation/layers.glsl"

uniform sampler2D linearDepth;  // from the light sample
uniform mat4 mapFromTexel;      // of the centre's view, from (x · depth, y · depth, depth, 1)
uniform int lightSample;
uniform int capacity;           // layers that there is room for; layerCount may exceed it

uint layerWith(uint key, uint head) {
    uint layer = head;
    while (layer != 0u && layers[fieldsOf(layer) + 1u] != key) layer = layers[fieldsOf(layer)];
    return layer;
}

/// The layer of a texel with this key, which is made if there is none. 0: there is no room for it.
uint layerOf(uint texel, uint key) {
    uint made = 0u, head = heads[texel], layer = layerWith(key, head);
    while (layer == 0u) {
        if (made == 0u) made = atomicAdd(layerCount, 1u) + 1u;
        if (made > uint(capacity)) return 0u;
        layers[fieldsOf(made)] = head;
        layers[fieldsOf(made) + 1u] = key;
        memoryBarrierBuffer();
        uint other = atomicCompSwap(heads[texel], head, made);
        layer = other == head ? made : layerWith(key, other);
        head = other;
    }
    return layer;
}

void main() {
    int side = textureSize(linearDepth, 0).x;
    uint i = invocation();
    if (i >= uint(side * side)) return;
    ivec2 texel = ivec2(int(i) % side, int(i) / side);
    float depth = abs(texelFetch(linearDepth, texel, 0).r);
    if (depth > 1e29) return;
    vec4 h = mapFromTexel * vec4((vec2(texel) + 0.5) / float(side) * depth, depth, 1.0);
    uint at = h.w > 0.0 ? texelOf(h.xy / h.w) : 0u;
    if (at == 0u) return;
    uint layer = layerOf(at - 1u, uint(depthKey(h.w)));
    if (layer == 0u) return;
    uint word = fieldsOf(layer) + 2u + uint(lightSample / 32), bit = 1u << (lightSample % 32);
    if ((layers[word] & bit) == 0u) atomicOr(layers[word], bit);
}
