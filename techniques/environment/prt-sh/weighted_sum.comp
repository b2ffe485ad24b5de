// The light that each compressed transfer vector lets through: the responses of its cluster's mean and components, which the
// processor has computed, weighted (course, "Reducing Storage Cost", VQ + PCA).
#include "gl/invocation.glsl"

layout(std430, binding = 0) readonly buffer Clusters { uint clusters[]; };  // of each vector
layout(std430, binding = 1) readonly buffer Weights { float weights[]; };   // component by component, each of all vectors
layout(std430, binding = 2) writeonly buffer Irradiance { float irradiance[]; };
layout(std430, binding = 3) readonly buffer Responses { float responses[]; };  // of each cluster: mean, then components

uniform int vectors, components;

void main() {
    uint number = invocation();
    if (number >= uint(vectors)) return;
    uint response = clusters[number] * uint(components + 1);
    float sum = responses[response];
    for (int i = 0; i < components; ++i) sum += weights[uint(i) * uint(vectors) + number] * responses[response + uint(i) + 1u];
    irradiance[number] = sum;
}
