// A Gaussian along one axis of an image; beyond the image its outermost pixels repeat.
uniform sampler2D image;
uniform vec2 axis;        // (1, 0) or (0, 1)
uniform vec2 taps[TAPS];  // offset in pixels, weight

out float blurred;

void main() {
    ivec2 last = textureSize(image, 0) - 1;
    float sum = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        ivec2 at = ivec2(floor(gl_FragCoord.xy + taps[i].x * axis));
        sum += taps[i].y * texelFetch(image, clamp(at, ivec2(0), last), 0).r;
    }
    blurred = sum;
}
