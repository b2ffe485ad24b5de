// The map of transmittance functions that deep_texture.h builds.
layout(std430, binding = 0) readonly buffer Firsts { uint first[]; };  // node with which a texel begins
layout(std430, binding = 1) readonly buffer Nodes { vec2 nodes[]; };   // depth, transmittance

uniform int side;  // texels per side

/// The texel's function (transmittance.h): 1 up to its first node, linear between nodes, constant behind the last.
float transmittanceAt(ivec2 texel, float depth) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(side)))) return 1.0;
    uint index = uint(texel.x + texel.y * side);
    uint before = first[index];
    uint behind = first[index + 1u];
    if (before == behind || depth <= nodes[before].x) return 1.0;
    uint last = behind - 1u;
    if (depth > nodes[last].x) return nodes[last].y;
    behind = last;
    while (behind - before > 1u) {  // nodes[before] < depth ≤ nodes[behind]
        uint middle = (before + behind) / 2u;
        if (depth <= nodes[middle].x) behind = middle;
        else before = middle;
    }
    vec2 a = nodes[before];
    vec2 b = nodes[behind];
    return mix(a.y, b.y, (depth - a.x) / (b.x - a.x));
}
