// Percentage-closer soft shadows over a map of linear depth: blocker search, penumbra width, filter. Shared by the techniques that
// start from it.
#include "gl/tangents.glsl"

uniform mat4 mapFromWorld;
uniform vec4 depthFromWorld;
uniform sampler2D linearDepth;   // negative: moving caster
uniform vec2 lightHalfSize;      // half the light's sides along map x and y, metres
uniform vec2 mapSpan;            // width and height of the map at unit depth
uniform float nearDepth;         // no caster is nearer to the light
uniform float followPlane;       // 1: taps are compared with the receiver's plane, 0: with the receiver's depth
uniform vec2 searchTaps[SEARCH_TAPS];  // in [−1, 1]²
uniform vec2 filterTaps[FILTER_TAPS];

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

/// Step 1: mean depth of the blockers in the light's projection from the receiver onto the near plane of the map; −1 if there is none.
float averageBlockerDepth(LightReceiver r) {
    vec2 window = lightHalfSize * max(r.depth - nearDepth, 0.0) / (r.depth * nearDepth) / mapSpan;
    float sum = 0.0;
    int found = 0;
    for (int i = 0; i < SEARCH_TAPS; ++i) {
        vec2 offset = searchTaps[i] * window;
        float depth = texture(linearDepth, r.at + offset).r;
        if (!blocks(depth, r, offset)) continue;
        sum += abs(depth);
        ++found;
    }
    return found > 0 ? sum / float(found) : -1.0;
}

/// Steps 2 and 3: penumbra width by similar triangles (Zápotocký eq. 3.3), then percentage-closer filtering over it.
float filteredVisibility(LightReceiver r, float blockerDepth) {
    vec2 halfPenumbra = lightHalfSize * max(r.depth - blockerDepth, 0.0) / blockerDepth / (r.depth * mapSpan);
    float passed = 0.0;
    for (int i = 0; i < FILTER_TAPS; ++i) {
        vec2 offset = filterTaps[i] * halfPenumbra;
        if (!blocks(texture(linearDepth, r.at + offset).r, r, offset)) passed += 1.0;
    }
    return passed / float(FILTER_TAPS);
}

float pcssVisibility(LightReceiver r, float blockerDepth) {
    return blockerDepth < 0.0 ? 1.0 : filteredVisibility(r, blockerDepth);
}
