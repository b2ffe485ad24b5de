// A triangle's bounding rectangle in the map: its sides are curves there, which the fragment shader tests.
#include "gl/triangles.glsl"
#include "maps/sm-log/log.glsl"

uniform int baseInstance;
uniform float texel;  // of the map, whose side is 1

flat out vec2 origin;                // on the light's plane: what the others are relative to
flat out vec3 side0, side1, side2;   // dot(·, (at − origin, 1)) ≥ 0 on the triangle's side
flat out vec3 depth;                 // dot(·, (at − origin, 1)) is depth, −1 to 1

const float least = 1e-6;

vec4 onPlane(uint triangle, uint corner, uint instance) {
    return planeFromWorld * vec4(worldCorner(triangle, corner, instance), 1.0);
}

/// Of a corner that lies before the warp's centre, anything.
vec2 cornerOnMap(vec4 h) {
    return onMap(vec2(h.x, max(h.y, least)) / max(h.w, least));
}

void main() {
    uint triangle = uint(gl_VertexID) / 6u, instance = uint(baseInstance + gl_InstanceID);
    vec4 h0 = onPlane(triangle, 0u, instance), h1 = onPlane(triangle, 1u, instance), h2 = onPlane(triangle, 2u, instance);

    // Wholly behind the light or the warp's centre a triangle is nowhere on the map, partly it may reach anywhere.
    bool none = max(max(h0.w, h1.w), h2.w) < 0.0 || max(max(h0.y, h1.y), h2.y) < 0.0;
    bool whole = min(min(h0.w, h1.w), h2.w) < least || min(min(h0.y, h1.y), h2.y) < least;
    vec2 m0 = cornerOnMap(h0), m1 = cornerOnMap(h1), m2 = cornerOnMap(h2);
    vec2 low = whole ? vec2(0.0) : min(min(m0, m1), m2) - texel, high = whole ? vec2(1.0) : max(max(m0, m1), m2) + texel;

    // Sides as rows of the inverse of the matrix of corners (Olano and Greer 1997): the weights of a point of the triangle over its w.
    origin = whole ? vec2(0.0) : h0.xy / h0.w;
    vec3 c0 = vec3(h0.xy - origin * h0.w, h0.w), c1 = vec3(h1.xy - origin * h1.w, h1.w), c2 = vec3(h2.xy - origin * h2.w, h2.w);
    float determinant = dot(c0, cross(c1, c2));
    side0 = cross(c1, c2) / determinant;
    side1 = cross(c2, c0) / determinant;
    side2 = cross(c0, c1) / determinant;
    depth = h0.z * side0 + h1.z * side1 + h2.z * side2;

    const int corners[6] = int[](0, 1, 2, 2, 1, 3);
    int corner = corners[gl_VertexID % 6];
    vec2 at = none ? vec2(0.0) : mix(low, high, vec2(corner & 1, corner >> 1));
    gl_Position = vec4(2.0 * clamp(at, -1.0, 2.0) - 1.0, 0.0, 1.0);
}
