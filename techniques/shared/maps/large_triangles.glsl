// Triangles that touch too many cells or pixels, or the light's plane: tested against every pixel instead.
layout(std430, binding = 6) buffer Large {
    uint largeCount;
    uint padding[3];
    vec4 largeCorners[];  // three a triangle
};

void handOn(vec3 v0, vec3 v1, vec3 v2) {
    uint slot = 3u * atomicAdd(largeCount, 1u);
    largeCorners[slot] = vec4(v0, 1.0);
    largeCorners[slot + 1u] = vec4(v1, 1.0);
    largeCorners[slot + 2u] = vec4(v2, 1.0);
}
