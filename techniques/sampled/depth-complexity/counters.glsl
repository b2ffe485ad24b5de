// For each pixel and each sample of the light, by how much more layers hide the sample than the light's middle: four to a word, a byte each,
// in two's complement of their sum.
layout(std430, binding = 1) buffer Counters { uint counters[]; };

const int words = (SAMPLES + 3) / 4;

uniform int width;  // of the image

uint firstWord(vec2 fragCoord) {
    return uint(words) * (uint(fragCoord.y) * uint(width) + uint(fragCoord.x));
}
