// The share of the light's samples that nothing hides: whose depth complexity is zero.
#include "sampled/depth-complexity/counters.glsl"

uniform sampler2D layers;  // before the light's middle

out float visibility;

/// The four changes of a word. 128 more in each byte leave no byte that borrows from the next.
ivec4 changes(uint word) {
    word += 0x80808080u;
    return ivec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24) - 128;
}

void main() {
    int ofMiddle = int(texelFetch(layers, ivec2(gl_FragCoord.xy), 0).r);
    uint first = firstWord(gl_FragCoord.xy);
    int seen = 0;
    for (int i = 0; i < words; ++i) {
        ivec4 complexity = ofMiddle + changes(counters[first + uint(i)]);
        bvec4 there = lessThan(4 * i + ivec4(0, 1, 2, 3), ivec4(SAMPLES));
        ivec4 one = ivec4(lessThanEqual(complexity, ivec4(0))) * ivec4(there);
        seen += one.x + one.y + one.z + one.w;
    }
    visibility = float(seen) / float(SAMPLES);
}
