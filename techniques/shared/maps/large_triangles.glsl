// Triangles that touch too many cells or pixels, or the light's plane: tested against every pixel instead. A later dispatch reads them
// as a texture (gl/texture.h, BufferTexture).
layout(std430, binding = 6) buffer Large {
    uint largeCount;
    uint padding[3];
    vec4 largeCorners[];  // three a triangle
};
uniform samplerBuffer largeTriangles;  // the whole block

vec3 largeCorner(uint number) {
    return texelFetch(largeTriangles, int(number) + 1).xyz;
}

void handOn(vec3 v0, vec3 v1, vec3 v2) {
    uint slot = 3u * atomicAdd(largeCount, 1u);
    largeCorners[slot] = vec4(v0, 1.0);
    largeCorners[slot + 1u] = vec4(v1, 1.0);
    largeCorners[slot + 2u] = vec4(v2, 1.0);
}
