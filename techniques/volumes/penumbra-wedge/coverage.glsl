// How much of the light lies behind an edge as seen from the light's middle, 0 to ½: what the course's four-dimensional tables hold, in
// closed form.

#include "volumes/seen_edge.glsl"

vec2 projected(SeenEdge edge, float share) {
    vec3 at = mix(edge.from, edge.to, share);
    return at.xy / max(at.z, 1e-30);
}

/// How far along the square's border, from (1, 0) counter-clockwise, the ray from its middle in a direction leaves it: −1 to 7.
float alongBorder(vec2 direction) {
    vec2 size = abs(direction);
    if (size.x >= size.y) return direction.y / (size.x > 0.0 ? direction.x : 1.0) + (direction.x < 0.0 ? 4.0 : 0.0);
    return (direction.y > 0.0 ? 2.0 : 6.0) - direction.x / direction.y;
}

/// The square's sector between the rays through a and b, less the triangle before the edge.
float coverageOfSquare(vec2 a, vec2 b) {
    float border = abs(alongBorder(a) - alongBorder(b));
    return (0.5 * min(border, 8.0 - border) - 0.5 * abs(a.x * b.y - a.y * b.x)) / 4.0;
}

/// The same of the unit disk, where the edge is clipped to it.
float coverageOfDisk(vec2 a, vec2 b) {
    vec2 along = b - a;
    float square = dot(along, along), half_ = dot(a, along), discriminant = half_ * half_ - square * (dot(a, a) - 1.0);
    if (square == 0.0 || discriminant <= 0.0) return 0.0;
    float root = sqrt(discriminant), begin = max(0.0, (-half_ - root) / square), end = min(1.0, (root - half_) / square);
    if (begin >= end) return 0.0;
    vec2 from = a + begin * along, to = a + end * along;
    float parallelogram = abs(from.x * to.y - from.y * to.x);
    return (0.5 * atan(parallelogram, dot(from, to)) - 0.5 * parallelogram) / radians(180.0);
}
