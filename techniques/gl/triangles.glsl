// The triangles of one batch in world space, for compute shaders (SceneBuffers::batches). The sums are those of gl/instance.glsl.
layout(std430, binding = 0) readonly buffer Vertices { float vertices[]; };      // x, y, z
layout(std430, binding = 1) readonly buffer Triangles { uint triangles[]; };     // three indices
layout(std430, binding = 2) readonly buffer Instances { float instances[]; };    // InstanceData of gl/scene_buffers.cpp

const uint instanceFloats = 26u;

vec4 instanceRow(uint instance, uint row) {
    uint i = instance * instanceFloats + 4u * row;
    return vec4(instances[i], instances[i + 1u], instances[i + 2u], instances[i + 3u]);
}

/// Corner 0, 1 or 2 of a triangle of an instance, in world space.
vec3 worldCorner(uint triangle, uint corner, uint instance) {
    uint v = 3u * triangles[3u * triangle + corner];
    vec4 p = vec4(vertices[v], vertices[v + 1u], vertices[v + 2u], 1.0);
    return vec3(dot(instanceRow(instance, 0u), p), dot(instanceRow(instance, 1u), p), dot(instanceRow(instance, 2u), p));
}
