#include "modern/pcss-vogel/soft_pixel.glsl"

out float visibility;

void main() {
    visibility = abs(softPixel());
}
