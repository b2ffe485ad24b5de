// A Gaussian along one axis of an image; beyond the image its outermost pixels repeat.
uniform sampler2D image;
uniform vec2 axis;          // (1, 0) or (0, 1)
uniform vec2 pairs[PAIRS];  // of taps at either side: offset in pixels, weight of each

out float blurred;

float imageAt(vec2 pixel) {
    return texelFetch(image, clamp(ivec2(floor(pixel)), ivec2(0), textureSize(image, 0) - 1), 0).r;
}

void main() {
    // Sums differences from the middle: where there are none, the image stays as it is to the last bit.
    float middle = imageAt(gl_FragCoord.xy);
    float change = 0.0;
    for (int i = 0; i < PAIRS; ++i) {
        vec2 offset = pairs[i].x * axis;
        change += pairs[i].y * (imageAt(gl_FragCoord.xy - offset) + imageAt(gl_FragCoord.xy + offset) - 2.0 * middle);
    }
    blurred = middle + change;
}
