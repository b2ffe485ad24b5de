// Triangles that touch too many cells, or the light's plane: tested against every pixel instead.
layout(std430, binding = 6) buffer Large {
    uint largeCount;
    uint padding[3];
    vec4 largeCorners[];  // three a triangle
};
