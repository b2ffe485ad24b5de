// Where a receiver lies in a shadow map, and the shadow test.
#include "gl/tangents.glsl"

uniform mat4 mapFromWorld;

struct MapPoint {
    vec3 at;      // x, y in [0, 1] over the map, depth in [0, 1]
    bool behind;  // behind the light: the map holds nothing there, taken as lit
};

/// The same as texelAt() of shared/light_views/light_view.h.
MapPoint mapPoint(vec3 world) {
    vec4 h = mapFromWorld * vec4(world, 1.0);
    return MapPoint(vec3(h.xy, min(h.z, h.w)) / h.w, h.w <= 0.0);
}

/// 1 lit, 0 shadowed (in between with a bilinear comparing sampler).
float shadowTest(sampler2DShadow map, MapPoint point) {
    return point.behind ? 1.0 : texture(map, point.at);
}

/// Change of map depth along the receiver's plane per unit of map x and y: the depth that a tap beside the receiver's own texel has
/// to be compared with. Zero where the plane is seen edge-on.
vec2 receiverPlaneSlope(vec3 world, vec3 normal, vec3 at) {
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
