// Where a receiver lies in a map of linear depth, and how deep its plane is beside it.
#include "gl/tangents.glsl"

uniform mat4 mapFromWorld;
uniform vec4 depthFromWorld;
uniform float followPlane;  // 1: texels beside the receiver's own are compared with its plane, 0: with its depth

struct LightReceiver {
    vec2 at;              // position in the map
    float depth;          // linear
    vec2 inverseSlope;    // change of 1 / depth along the receiver's plane per unit of map x and y (1 / depth is linear there)
    bool behind;
};

LightReceiver lightReceiver(vec3 world, vec3 normal) {
    vec4 h = mapFromWorld * vec4(world, 1.0);
    LightReceiver r = LightReceiver(h.xy / h.w, dot(depthFromWorld, vec4(world, 1.0)), vec2(0.0), h.w <= 0.0);
    Tangents t = tangentsOf(normal);
    vec4 hu = mapFromWorld * vec4(t.u, 0.0);
    vec4 hv = mapFromWorld * vec4(t.v, 0.0);
    vec2 du = (hu.xy - r.at * hu.w) / h.w;
    vec2 dv = (hv.xy - r.at * hv.w) / h.w;
    float determinant = du.x * dv.y - du.y * dv.x;
    if (abs(determinant) < 1e-12) return r;  // seen edge-on from the light
    float zu = dot(depthFromWorld.xyz, t.u);
    float zv = dot(depthFromWorld.xyz, t.v);
    vec2 slope = vec2(zu * dv.y - zv * du.y, zv * du.x - zu * dv.x) / determinant;
    r.inverseSlope = -followPlane * slope / (r.depth * r.depth);
    return r;
}

/// 1 / depth of the receiver's plane beside the receiver's own texel; 0 and less where it never comes before the light.
float planeInverseDepth(LightReceiver r, vec2 offset) {
    return 1.0 / r.depth + dot(r.inverseSlope, offset);
}

float planeDepth(LightReceiver r, vec2 offset) {
    float inverse = planeInverseDepth(r, offset);
    return inverse > 0.0 ? 1.0 / inverse : 1e30;
}
