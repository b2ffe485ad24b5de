// The light that each transfer vector lets through: its dot product with the light's coefficients.
#include "gl/invocation.glsl"

layout(std430, binding = 0) readonly buffer Transfer { float transfer[]; };  // coefficient by coefficient, each of all vectors
layout(std430, binding = 1) readonly buffer LightCoefficients { float light[]; };
layout(std430, binding = 2) writeonly buffer Irradiance { float irradiance[]; };

uniform int vectors, coefficients;

void main() {
    uint number = invocation();
    if (number >= uint(vectors)) return;
    float sum = 0.0;
    for (int i = 0; i < coefficients; ++i) sum += transfer[uint(i) * uint(vectors) + number] * light[i];
    irradiance[number] = sum;
}
