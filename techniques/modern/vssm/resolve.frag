#include "filtered/moments.glsl"
#include "filtered/unit_depth.glsl"
#include "gl/normal.glsl"
#include "gl/receiver.glsl"
#include "modern/sat-vsm/summed_moments.glsl"
#include "shared/maps/light_space.glsl"

uniform usampler2D sums;
uniform vec3 lightU;
uniform vec3 lightV;
uniform vec2 mapSpan;
uniform vec2 nearAndFar;

out float visibility;

/// A receiver in the map: its place, and how window depth changes along its plane per unit of map x and y.
struct Plane {
    vec3 at;
    vec2 slope;
};

/// How much of a kernel is lit, and the depths of the rest of it, added up.
struct Shares {
    float lit, blockers;
};

float depthOf(Plane plane, vec2 offset) {
    return unitDepth(plane.at.z + dot(plane.slope, offset));
}

/// Of a part of the kernel whose mean is not before the receiver: four texels, compared one by one with the plane at their middles.
Shares compared(Plane plane, vec2 middle, vec2 reach) {
    Shares shares = Shares(0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 place = plane.at.xy + middle + (vec2(i & 1, i >> 1) - 0.5) * reach;
        vec2 offset = (floor(place * float(MAP)) + 0.5) / float(MAP) - plane.at.xy;
        float depth = unitDepth(textureLod(windowDepths, plane.at.xy + offset, 0.0).r);
        bool lit = depth >= depthOf(plane, offset) - sqrt(VARIANCE);
        shares.lit += lit ? 0.25 : 0.0;
        shares.blockers += lit ? 0.0 : 0.25 * depth;
    }
    return shares;
}

/// By moments: what is lit is taken to be as deep as the receiver (the paper's equation 5).
Shares bounded(float mean, float square, float depth) {
    float lit = chebyshevBound(vec2(mean, square), depth, VARIANCE);
    return Shares(lit, max(mean - lit * depth, 0.0));
}

/// Of a kernel that reaches so far to each side of the receiver. Where its mean is not before the receiver, no bound holds of it as a
/// whole; its parts are then taken one by one (section 4).
Shares sharesOf(Plane plane, vec2 reach) {
    vec2 size = vec2(MAP), middle = plane.at.xy * size;
    vec2 moments = meanMoments(sums, middle - reach * size, middle + reach * size);
    float depth = depthOf(plane, vec2(0.0));
    if (depth > moments.x) return bounded(moments.x, moments.y, depth);
    Shares all = Shares(0.0, 0.0);
    ivec2 parts = clamp(ivec2(2.0 * reach * size), ivec2(1), ivec2(PARTS));  // of a texel at least
    vec2 part = reach / vec2(parts);
    for (int i = 0; i < parts.x * parts.y; ++i) {
        vec2 offset = (vec2(i % parts.x, i / parts.x) * 2.0 + 1.0) * part - reach;
        vec2 own = meanMoments(sums, middle + (offset - part) * size, middle + (offset + part) * size);
        float there = depthOf(plane, offset);
        Shares shares = there > own.x ? bounded(own.x, own.y, there) : compared(plane, offset, part);
        all.lit += shares.lit;
        all.blockers += shares.blockers;
    }
    float count = float(parts.x * parts.y);
    return Shares(all.lit / count, all.blockers / count);
}

/// How far a kernel reaches at least: a texel has room in it.
const float halfTexel = 0.5 / float(MAP);

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    if (any(lessThan(point.at.xy, vec2(0.0))) || any(greaterThan(point.at.xy, vec2(1.0)))) return;
    Plane plane = Plane(point.at, receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at));

    vec2 halfLight = 0.5 * vec2(length(lightU), length(lightV));
    float metres = nearAndFar.y - nearAndFar.x, depth = nearAndFar.x + metres * depthOf(plane, vec2(0.0));
    vec2 perInverse = halfLight / mapSpan;  // of the light's image, per 1/z − 1/depth
    vec2 window = perInverse * max(1.0 / nearAndFar.x - 1.0 / depth, 0.0);
    if (halfLight == vec2(0.0)) window = vec2(0.0);

    Shares search = sharesOf(plane, max(window, halfTexel));
    if (search.lit > 0.999) return;
    float blocker = nearAndFar.x + metres * search.blockers / (1.0 - search.lit);
    vec2 penumbra = halfLight == vec2(0.0) ? vec2(0.0) : perInverse * max(1.0 / blocker - 1.0 / depth, 0.0);
    visibility = sharesOf(plane, max(penumbra, halfTexel)).lit;
}
