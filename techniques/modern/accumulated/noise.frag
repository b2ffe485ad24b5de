#include "modern/pcss-vogel/soft_pixel.glsl"

out float noisy;

void main() {
    noisy = softPixel();
}
