// Percentage-closer soft shadows (Fernando 2005) with few taps of a Vogel disk: 1. blocker search  2. penumbra width from similar
// triangles  3. filter. Taps are those of a disk that fits into the light's sides: engines know no other shape.
#include "shared/maps/linearised_map.glsl"
#include "shared/maps/plane_slope.glsl"
#include "shared/sampling/vogel.glsl"

uniform sampler2D depths;  // window depths
uniform float followPlane;
uniform vec3 lightU, lightV;

struct SoftReceiver {
    vec3 at;      // in the texture, with window depth
    vec2 slope;   // of its plane's window depth over the texture
    float depth;  // metres along the light's axis
    bool behind;  // the light: the map holds nothing there
    vec2 span;    // width and height of the texture at unit distance
    int tile;     // of the texture
};

#if CASCADES > 0
#include "modern/pcss-vogel/cascades.glsl"
#else
#include "modern/pcss-vogel/one_map.glsl"
#endif

/// Half the light's sides, along map x and y.
vec2 lightReach() {
    return 0.5 * vec2(length(lightU), length(lightV));
}

/// Whether the map holds something before the receiver's plane beside the receiver; `stored` is its window depth.
bool blocksAt(SoftReceiver r, vec2 offset, out float stored) {
    vec2 within = offsetWithin(r, offset);
    stored = textureLod(depths, r.at.xy + within, 0.0).r;
    return stored < min(r.at.z + dot(r.slope, within), 1.0);
}

/// Where blockers are looked for: what the receiver sees of the light, or of a narrower cone, on the map's near plane. In map x and y.
vec2 searchReach(SoftReceiver r) {
    float near = nearDistance();
    vec2 tangent = min(lightReach() / r.depth, vec2(tan(radians(0.5 * float(CONE)))));
    return tangent * max(r.depth - near, 0.0) / (near * r.span);
}

/// A tap of the search. An exponent above 1 has taps where a disk of few has none: within its first radius, √(½ / n).
vec2 searchTap(int i, float turn) {
    vec2 tap = vogelTap(i, BLOCKERS, turn);
    return pow(length(tap), float(CROWDING) - 1.0) * tap;
}

/// Mean depth of the blockers that are found, metres; negative without one.
float meanBlockerDepth(SoftReceiver r, float turn) {
    vec2 reach = searchReach(r);
    float sum = 0.0, stored, found = 0.0;
    for (int i = 0; i < BLOCKERS; ++i)
        if (blocksAt(r, reach * searchTap(i, turn), stored)) {
            sum += metresOf(stored);
            ++found;
        }
    return found > 0.0 ? sum / found : -1.0;
}

/// Half the penumbra's width at the receiver, in metres along map x and y.
vec2 halfPenumbra(float receiver, float blocker) {
    return min(lightReach() * max(receiver - blocker, 0.0) / blocker, vec2(0.5 * float(WIDEST)));
}

/// The share of the light that is seen. `turns`: of the blocker search and of the filter, radians.
float softVisibility(SoftReceiver r, vec2 turns) {
    float blocker = meanBlockerDepth(r, turns.x);
    if (blocker < 0.0) return 1.0;
    vec2 reach = max(halfPenumbra(r.depth, blocker) / (r.depth * r.span), float(NARROWEST) / vec2(textureSize(depths, 0)));
    float passed = 0.0, stored;
    for (int i = 0; i < TAPS; ++i)
        if (!blocksAt(r, reach * vogelTap(i, TAPS, turns.y), stored)) ++passed;
    return passed / float(TAPS);
}
