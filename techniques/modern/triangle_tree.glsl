// Shadow rays through all triangles of the scene (techniques/modern/triangle_tree.h).
struct TreeNode {
    vec3 low;
    uint after;
    vec3 high;
    uint triangle;
};
uniform usamplerBuffer nodes;   // two texels each
uniform samplerBuffer corners;  // three a triangle

TreeNode nodeAt(uint number) {
    uvec4 low = texelFetch(nodes, 2 * int(number)), high = texelFetch(nodes, 2 * int(number) + 1);
    return TreeNode(uintBitsToFloat(low.xyz), low.w, uintBitsToFloat(high.xyz), high.w);
}

vec3 cornerAt(uint number) {
    return texelFetch(corners, int(number)).xyz;
}

/// The segment from `from` to `from` + 1 / `inverse`.
bool meetsBox(TreeNode node, vec3 from, vec3 inverse) {
    vec3 a = (node.low - from) * inverse;
    vec3 b = (node.high - from) * inverse;
    vec3 first = min(a, b);
    vec3 last = max(a, b);
    const float rounding = 1.0 + 1e-6;  // more than three roundings: a flat box would be missed (Ize 2013)
    return max(max(first.x, first.y), max(first.z, 0.0)) <= rounding * min(min(last.x, last.y), min(last.z, 1.0));
}

/// Möller and Trumbore 1997; its ends do not belong to the segment.
bool meetsTriangle(uint number, vec3 from, vec3 segment) {
    vec3 a = cornerAt(3u * number);
    vec3 ab = cornerAt(3u * number + 1u) - a;
    vec3 ac = cornerAt(3u * number + 2u) - a;
    vec3 p = cross(segment, ac);
    float determinant = dot(ab, p);
    if (determinant == 0.0) return false;
    vec3 s = (from - a) / determinant;
    vec3 q = cross(s, ab);
    float u = dot(s, p), v = dot(segment, q), t = dot(ac, q);
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 1.0;
}

/// No node is followed by the first. Of a block that is drawn in part llvmpipe runs the other pixels, too, and has them read zeros: they
/// would begin again and again.
bool segmentIsBlocked(vec3 from, vec3 to) {
    vec3 segment = to - from;
    vec3 inverse = 1.0 / mix(segment, vec3(1e-20), equal(segment, vec3(0.0)));
    uint end = uint(textureSize(nodes)) / 2u;
    for (uint i = 0u; i < end;) {
        TreeNode node = nodeAt(i);
        if (node.after == 0u) break;
        bool met = meetsBox(node, from, inverse);
        if (met && node.triangle != 0u && meetsTriangle(node.triangle - 1u, from, segment)) return true;
        i = met ? i + 1u : node.after;
    }
    return false;
}
