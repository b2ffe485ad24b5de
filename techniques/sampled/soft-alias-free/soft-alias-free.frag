// The share of the light samples that no triangle hides.
layout(std430, binding = 5) readonly buffer Results { uint results[]; };

uniform int width;
uniform int samples;

out float visibility;

void main() {
    int first = (int(gl_FragCoord.y) * width + int(gl_FragCoord.x)) * WORDS;
    uint lastWord = 0xFFFFFFFFu >> (32 * WORDS - samples);  // without the bits past the last sample
    int hidden = bitCount(results[first + WORDS - 1] & lastWord);
    for (int word = 0; word < WORDS - 1; ++word) hidden += bitCount(results[first + word]);
    visibility = 1.0 - float(hidden) / float(samples);
}
