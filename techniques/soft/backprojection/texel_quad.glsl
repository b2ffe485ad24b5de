// A texel of the map as the receiver sees it on the light: a rectangle with the light's own directions (Guennebaud et al. 2006).

/// Share of the light, which is [−1, 1]², within the rectangle.
float shareOfLight(vec2 low, vec2 high) {
    vec2 inside = max(min(high, vec2(1.0)) - max(low, vec2(-1.0)), vec2(0.0));
    return 0.25 * inside.x * inside.y;
}

/// The rectangle's upper end, moved to where the neighbour's rectangle begins if there is a gap between them.
float upToNeighbour(float high, float neighboursLow) {
    return max(high, neighboursLow);
}
