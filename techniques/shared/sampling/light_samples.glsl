// Samples on a light as bits (shared/sampling/light_samples.h): SAMPLES a row and as many rows.

/// How far a row's first sample lies within its cell, in cells.
float rowShift(int row) {
    uint reversed = bitfieldReverse(uint(row)) >> (32 - findMSB(SAMPLES));
    return (float(reversed) + 0.5) / float(SAMPLES);
}

/// In cells: the light is [0, SAMPLES]².
vec2 lightSample(int row, int i) {
    return vec2(float(i) + rowShift(row), float(row) + (float(i) + 0.5) / float(SAMPLES));
}

/// Four edges of a quad, in cells.
struct QuadEdges {
    vec4 fromX, fromY;
    vec4 alongX, alongY;
    vec4 inverseSlope;  // of the distance from the edge, positive inside, from one sample of a row to the next
};

/// Corners counterclockwise, on the light as [−1, 1]².
QuadEdges edgesOf(vec2 a, vec2 b, vec2 c, vec2 d) {
    const float cells = 0.5 * float(SAMPLES);
    vec4 x = (vec4(a.x, b.x, c.x, d.x) + 1.0) * cells;
    vec4 y = (vec4(a.y, b.y, c.y, d.y) + 1.0) * cells;
    vec4 alongX = x.yzwx - x;
    vec4 alongY = y.yzwx - y;
    vec4 slope = alongX / float(SAMPLES) - alongY;
    return QuadEdges(x, y, alongX, alongY, 1.0 / mix(slope, vec4(1e-20), equal(slope, vec4(0.0))));
}

/// The samples of a row on the inner side of all four edges: a run of bits from the lowest on.
uint runOfRow(QuadEdges e, int row) {
    vec2 first = lightSample(row, 0);
    vec4 crossing = (e.alongY * (first.x - e.fromX) - e.alongX * (first.y - e.fromY)) * e.inverseSlope;
    bvec4 rising = greaterThan(e.inverseSlope, vec4(0.0));
    vec4 from = mix(vec4(0.0), crossing, rising);
    vec4 to = mix(crossing, vec4(SAMPLES - 1), rising);
    int low = int(ceil(clamp(max(max(from.x, from.y), max(from.z, from.w)), 0.0, float(SAMPLES))));
    int high = int(floor(clamp(min(min(to.x, to.y), min(to.z, to.w)), -1.0, float(SAMPLES - 1))));
    return high < low ? 0u : (2u << high) - (1u << low);
}

/// Rows that the quad reaches into; none where the second is less than the first.
ivec2 rowsOf(QuadEdges e) {
    float low = min(min(e.fromY.x, e.fromY.y), min(e.fromY.z, e.fromY.w));
    float high = max(max(e.fromY.x, e.fromY.y), max(e.fromY.z, e.fromY.w));
    return ivec2(floor(clamp(low, 0.0, float(SAMPLES))), floor(clamp(high, -1.0, float(SAMPLES - 1))));
}
