// Shadow test against the deformed depth mesh: the receiver's cell of the dual grid is split into four quadrants by lines from its
// silhouette point to those of its neighbours; each quadrant takes the test of the depth sample in its corner.
// To be counted, with TESTED or BRANCH defined only the pixels are drawn that are tested at all, or that take the branch; with
// FACING only those of them that face the light.
#include "shared/maps/tested_point.glsl"

uniform sampler2D depthMap;
uniform sampler2D silhouetteMap;

#ifdef FACING
uniform vec4 light;  // homogeneous
#endif

out float visibility;

#if defined(TESTED) || defined(BRANCH)
#define LEAVE discard
#else
#define LEAVE return
#endif

float testAt(ivec2 texel, float depth) {
    ivec2 size = textureSize(depthMap, 0);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) return 1.0;
    return depth <= texelFetch(depthMap, texel, 0).r ? 1.0 : 0.0;
}

/// Silhouette point of a neighbouring cell, in this cell's coordinates.
vec2 pointOf(ivec2 cell, ivec2 offset) {
    ivec2 at = clamp(cell + offset, ivec2(0), textureSize(silhouetteMap, 0) - 1);
    return texelFetch(silhouetteMap, at, 0).xy + vec2(offset);
}

float cross2(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Whether `p` lies in the wedge from `a` counter-clockwise to `b`, of at most half a turn, all seen from its apex.
bool inWedge(vec2 a, vec2 b, vec2 p) {
    return cross2(a, p) >= 0.0 && cross2(p, b) >= 0.0;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = testedPoint(receiver);
    visibility = 1.0;
    if (!receiver.seen || point.behind) LEAVE;
#ifdef FACING
    if (dot(normalAt(gl_FragCoord.xy), light.xyz - light.w * receiver.position) <= 0.0) LEAVE;
#endif

    vec2 dual = point.at.xy * vec2(textureSize(depthMap, 0)) + 0.5;
    ivec2 cell = ivec2(floor(dual));
    float bottomLeft = testAt(cell - ivec2(1, 1), point.at.z), bottomRight = testAt(cell - ivec2(0, 1), point.at.z);
    float topLeft = testAt(cell - ivec2(1, 0), point.at.z), topRight = testAt(cell, point.at.z);
    visibility = bottomLeft;
#ifdef TESTED
    return;
#endif
    if (bottomLeft == bottomRight && bottomLeft == topLeft && bottomLeft == topRight) LEAVE;

    vec2 centre = pointOf(cell, ivec2(0));
    vec2 p = fract(dual) - centre;
    vec2 left = pointOf(cell, ivec2(-1, 0)) - centre, right = pointOf(cell, ivec2(1, 0)) - centre;
    vec2 bottom = pointOf(cell, ivec2(0, -1)) - centre, top = pointOf(cell, ivec2(0, 1)) - centre;
    vec2 corner = -centre;
    if (inWedge(left, corner, p) || inWedge(corner, bottom, p)) return;
    corner = vec2(1.0, 0.0) - centre;
    if (inWedge(bottom, corner, p) || inWedge(corner, right, p)) {
        visibility = bottomRight;
        return;
    }
    corner = vec2(1.0) - centre;
    visibility = inWedge(right, corner, p) || inWedge(corner, top, p) ? topRight : topLeft;
}
