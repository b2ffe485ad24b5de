// A triangle's bounding rectangle in the grid, and the triangle's sides moved outwards by half a cell: conservative rasterisation as of
// Hasselgren, Akenine-Möller and Ohlsson 2005.
#include "gl/triangles.glsl"

uniform mat4 mapFromWorld;
uniform int baseInstance;
uniform float cell;  // a grid's side is 1

flat out vec3 v0, v1, v2;           // corners, in the world
flat out vec3 side0, side1, side2;  // dot(·, (at, 1)) ≥ 0 where a cell's centre is no farther out than the side of a cell that is touched

const float margin = 0.5 + 0.125;     // cells: from a cell's centre to its side, and the rounding of positions in the grid
const float productRounding = 4e-6;   // of a cross product, in parts of its factors' lengths

vec3 movedOut(vec3 from, vec3 to, float facing) {
    vec3 side = facing * cross(from, to);
    side.z += margin * cell * (abs(side.x) + abs(side.y)) + productRounding * length(from) * length(to);
    return side;
}

void main() {
    uint triangle = uint(gl_VertexID) / 6u, instance = uint(baseInstance + gl_InstanceID);
    v0 = worldCorner(triangle, 0u, instance);
    v1 = worldCorner(triangle, 1u, instance);
    v2 = worldCorner(triangle, 2u, instance);
    vec3 h0 = (mapFromWorld * vec4(v0, 1.0)).xyw, h1 = (mapFromWorld * vec4(v1, 1.0)).xyw, h2 = (mapFromWorld * vec4(v2, 1.0)).xyw;

    // Sides in homogeneous coordinates hold for triangles that cross the light's plane, too (Olano and Greer 1997).
    float facing = dot(h0, cross(h1, h2)) < 0.0 ? -1.0 : 1.0;
    side0 = movedOut(h1, h2, facing);
    side1 = movedOut(h2, h0, facing);
    side2 = movedOut(h0, h1, facing);

    const float least = 1e-6;
    vec3 w = max(vec3(h0.z, h1.z, h2.z), least);
    vec2 p0 = h0.xy / w.x, p1 = h1.xy / w.y, p2 = h2.xy / w.z;
    bool whole = min(min(h0.z, h1.z), h2.z) < least, none = max(max(h0.z, h1.z), h2.z) < 0.0;
    vec2 low = whole ? vec2(0.0) : min(min(p0, p1), p2) - margin * cell, high = whole ? vec2(1.0) : max(max(p0, p1), p2) + margin * cell;

    const int corners[6] = int[](0, 1, 2, 2, 1, 3);
    int corner = corners[gl_VertexID % 6];
    vec2 at = none ? vec2(0.0) : mix(low, high, vec2(corner & 1, corner >> 1));
    gl_Position = vec4(2.0 * clamp(at, -1.0, 2.0) - 1.0, 0.0, 1.0);
}
