// The share of the light samples that see the receiver's layer.
#include "gl/receiver.glsl"
#include "sampled/layered-attenuation/layers.glsl"
#include "shared/maps/light_receiver.glsl"

uniform sampler2D normals;

out float visibility;

/// The keys of the depths that the receiver's plane has within a texel, and one more on each side.
ivec2 keysOf(LightReceiver r) {
    float inverse = 1.0 / r.depth, reach = (abs(r.inverseSlope.x) + abs(r.inverseSlope.y)) / float(layerSide);
    return ivec2(depthKey(1.0 / (inverse + reach)) - 1, depthKey(1.0 / max(inverse - reach, 0.1 * inverse)) + 1);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    LightReceiver r = lightReceiver(receiver.position, texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    uint at = receiver.seen && !r.behind ? texelOf(r.at) : 0u;
    visibility = 1.0;
    if (at == 0u) return;
    ivec2 keys = keysOf(r);
    uint bits[WORDS];
    for (int word = 0; word < WORDS; ++word) bits[word] = 0u;
    for (uint layer = heads[at - 1u]; layer != 0u; layer = layers[fieldsOf(layer)]) {
        uint fields = fieldsOf(layer);
        int key = int(layers[fields + 1u]);
        uint mask = key >= keys.x && key <= keys.y ? 0xFFFFFFFFu : 0u;
        for (int word = 0; word < WORDS; ++word) bits[word] |= mask & layers[fields + 2u + uint(word)];
    }
    int seen = 0;
    for (int word = 0; word < WORDS; ++word) seen += bitCount(bits[word]);
    visibility = float(seen) / float(SAMPLES);
}
