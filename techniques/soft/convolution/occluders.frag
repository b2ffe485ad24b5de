#include "soft/convolution/layers_of.glsl"

flat in uint surface;

out uint bits;

void main() {
    bits = layersOfPolygon[surfaces[surface].firstPolygon + uint(gl_PrimitiveID)];
}
