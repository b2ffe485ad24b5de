#include "soft/convolution/layer_of.glsl"

flat in uint surface;

out uint bits;

void main() {
    bits = 1u << layerOf[surface];
}
