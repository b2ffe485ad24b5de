// A receiver's plane in a shadow map.
#include "gl/tangents.glsl"

/// Change of map depth along the plane per unit of map x and y: the depth that a tap beside the receiver's own texel has to be compared
/// with. Zero where the plane is seen edge-on. `at`: where the receiver lies in the map.
vec2 planeSlope(mat4 mapFromWorld, vec3 normal, vec3 at) {
    Tangents t = tangentsOf(normal);
    // d(h.xyz / h.w) along a tangent t is (M t − at · (M t).w) / h.w; the common factor 1 / h.w cancels in the slope.
    vec4 hu = mapFromWorld * vec4(t.u, 0.0);
    vec4 hv = mapFromWorld * vec4(t.v, 0.0);
    vec3 du = hu.xyz - at * hu.w;
    vec3 dv = hv.xyz - at * hv.w;
    float determinant = du.x * dv.y - du.y * dv.x;
    if (abs(determinant) < 1e-12) return vec2(0.0);
    return vec2(du.z * dv.y - dv.z * du.y, dv.z * du.x - du.z * dv.x) / determinant;
}
