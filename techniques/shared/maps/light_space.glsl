// Where a receiver lies in a shadow map, and the shadow test.
uniform mat4 mapFromWorld;

struct MapPoint {
    vec3 at;      // x, y in [0, 1] over the map, depth in [0, 1]
    bool behind;  // behind the light: no map can tell, taken as lit
};

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
    vec3 u = normalize(abs(normal.x) < 0.5 ? cross(normal, vec3(1, 0, 0)) : cross(normal, vec3(0, 1, 0)));
    vec3 v = cross(normal, u);
    // d(h.xyz / h.w) along a tangent t is (M t − at · (M t).w) / h.w; the common factor 1 / h.w cancels in the slope.
    vec4 hu = mapFromWorld * vec4(u, 0.0);
    vec4 hv = mapFromWorld * vec4(v, 0.0);
    vec3 du = hu.xyz - at * hu.w;
    vec3 dv = hv.xyz - at * hv.w;
    float determinant = du.x * dv.y - du.y * dv.x;
    if (abs(determinant) < 1e-12) return vec2(0.0);
    return vec2(du.z * dv.y - dv.z * du.y, dv.z * du.x - du.z * dv.x) / determinant;
}
