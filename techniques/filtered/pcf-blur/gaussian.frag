// A Gaussian along one axis of an image; beyond the image its outermost pixels repeat.
const int reach = 7; // pixels to either side of the middle tap

uniform sampler2D IMAGE;
uniform vec2 pairs[reach]; // of taps at either side: offset in pixels, weight of each

out float blurred;

float imageAt(vec2 pixel) {
    return texelFetch(IMAGE, clamp(ivec2(floor(pixel)), ivec2(0), textureSize(IMAGE, 0) - 1), 0).r;
}

void main() {
    // Sums differences from the middle: where there are none, the image stays as it is to the last bit.
    float middle = imageAt(gl_FragCoord.xy);
    float change = 0.0;
    for (int i = 0; i < reach; ++i) {
        vec2 offset = pairs[i].x * AXIS;
        change += pairs[i].y * (imageAt(gl_FragCoord.xy - offset) + imageAt(gl_FragCoord.xy + offset) - 2.0 * middle);
    }
    blurred = middle + change;
}
