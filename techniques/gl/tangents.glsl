// Two unit vectors that span a surface's plane, for what changes along it.
struct Tangents {
    vec3 u, v;
};

/// `normal`: of unit length, at right angles to both.
Tangents tangentsOf(vec3 normal) {
    vec3 u = normalize(abs(normal.x) < 0.5 ? cross(normal, vec3(1, 0, 0)) : cross(normal, vec3(0, 1, 0)));
    return Tangents(u, cross(normal, u));
}
