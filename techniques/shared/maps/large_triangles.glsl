// Triangles that touch too many cells or pixels, or the light's plane: tested against tiles of pixels instead. Later dispatches read them
// as a texture (gl/texture.h, BufferTexture), each as many as it can test at once.
layout(std430, binding = 6) buffer Large {
    uint largeCount;
    uint groupsOfLater[3];  // of each dispatch but the first: 0 while that one can test them all
    vec4 largeCorners[];  // three a triangle
};
uniform samplerBuffer largeTriangles;  // the whole block
uniform int mostLarge;                 // triangles of a dispatch
uniform sampler2D positions;

const int tileSide = 8;  // pixels of a work group

vec3 largeCorner(uint number) {
    return texelFetch(largeTriangles, int(number) + 1).xyz;
}

void handOn(vec3 v0, vec3 v1, vec3 v2) {
    uint slot = atomicAdd(largeCount, 1u), corner = 3u * slot;
    largeCorners[corner] = vec4(v0, 1.0);
    largeCorners[corner + 1u] = vec4(v1, 1.0);
    largeCorners[corner + 2u] = vec4(v2, 1.0);
    if (slot < uint(mostLarge)) return;
    ivec2 tiles = (textureSize(positions, 0) + tileSide - 1) / tileSide;
    groupsOfLater[0] = uint(tiles.x);
    groupsOfLater[1] = uint(tiles.y);
    groupsOfLater[2] = 1u;
}
