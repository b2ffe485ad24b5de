// A receiver before a map of linear depth: what blocks it, and how far blocker search and filter of percentage-closer soft shadows
// reach. Shared by what searches such a map.
#include "gl/tangents.glsl"

uniform mat4 mapFromWorld;
uniform vec4 depthFromWorld;
uniform sampler2D linearDepth;   // negative: moving caster
uniform vec2 lightHalfSize;      // half the light's sides along map x and y, metres
uniform vec2 mapSpan;            // width and height of the map at unit depth
uniform float nearDepth;         // no caster is nearer to the light
uniform float followPlane;       // 1: taps are compared with the receiver's plane, 0: with the receiver's depth

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

/// Depth of the receiver's plane beside the receiver's own texel.
float planeDepth(LightReceiver r, vec2 offset) {
    float inverse = 1.0 / r.depth + dot(r.inverseSlope, offset);
    return inverse > 0.0 ? 1.0 / inverse : 1e30;
}

bool blocks(float mapDepth, LightReceiver r, vec2 offset) {
    return abs(mapDepth) < planeDepth(r, offset);
}

/// Half the sides of the light's projection from the receiver onto the near plane of the map, in map x and y: blockers lie in it.
vec2 searchWindow(LightReceiver r) {
    return lightHalfSize * max(r.depth - nearDepth, 0.0) / (r.depth * nearDepth) / mapSpan;
}

/// Half the penumbra's widths by similar triangles (Zápotocký eq. 3.3), in map x and y.
vec2 halfPenumbra(LightReceiver r, float blockerDepth) {
    return lightHalfSize * max(r.depth - blockerDepth, 0.0) / blockerDepth / (r.depth * mapSpan);
}
