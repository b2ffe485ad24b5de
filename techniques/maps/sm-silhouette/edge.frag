// The silhouette point of a cell: a point of the edge within it (course, "Silhouette Point Algorithm", cases 1 to 4).
#include "gl/half.glsl"

uniform sampler2D depthMap;

flat in vec3 from;
flat in vec3 to;

out vec2 point;

bool inside(vec2 p) {
    return all(greaterThanEqual(p, vec2(0.0))) && all(lessThan(p, vec2(1.0)));
}

/// Where the edge p–q crosses the line that `signedP` and `signedQ` are the distances to; negative where it does not, within the cell.
float crossing(vec2 p, vec2 q, float signedP, float signedQ) {
    if ((signedP > 0.0) == (signedQ > 0.0)) return -1.0;
    float t = signedP / (signedP - signedQ);
    return inside(mix(p, q, t)) ? t : -1.0;
}

/// Position along the edge of the point to store; negative: none.
float pick(vec2 p, vec2 q) {
    if (inside(p)) return 0.0;  // case 1: an end of the edge
    if (inside(q)) return 1.0;
    float rising = crossing(p, q, p.x - p.y, q.x - q.y), falling = crossing(p, q, p.x + p.y - 1.0, q.x + q.y - 1.0);
    if (rising < 0.0) return falling;               // case 2: one diagonal, or case 4: none
    if (falling < 0.0) return rising;               // case 2
    return 0.5 * (rising + falling);                // case 3: both
}

/// Deepest of the four samples at the corners of the cell.
float deepestCorner(ivec2 cell) {
    float deepest = 0.0;
    ivec2 last = textureSize(depthMap, 0) - 1;
    for (int corner = 0; corner < 4; ++corner)
        deepest = max(deepest, texelFetch(depthMap, clamp(cell - ivec2(corner & 1, corner >> 1), ivec2(0), last), 0).r);
    return deepest;
}

void main() {
    vec2 cell = floor(gl_FragCoord.xy);
    float t = pick(from.xy - cell, to.xy - cell);
    if (t < 0.0) discard;
#ifndef CROSSED  // else: all cells that edges cross, to be counted
    if (mix(from.z, to.z, t) > deepestCorner(ivec2(cell))) discard;  // hidden from the light
#endif
    point = toHalf(mix(from.xy, to.xy, t) - cell);
}
