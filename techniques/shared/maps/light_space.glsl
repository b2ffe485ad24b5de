// Where a receiver lies in a shadow map, and the shadow test.
#include "shared/maps/plane_slope.glsl"

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

/// The receiver's plane in the map: planeSlope().
vec2 receiverPlaneSlope(vec3 world, vec3 normal, vec3 at) { return planeSlope(mapFromWorld, normal, at); }
