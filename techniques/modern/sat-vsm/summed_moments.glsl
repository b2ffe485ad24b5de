// Summed areas of depth and its square in whole numbers (Lauritzen 2007, GPU Gems 3, sections 8.5.1 and 8.5.2). Sums may pass 2³²:
// differences of them are right as long as what they are of, a block of texels, has no more. Blocks have 32 texels a side at most, which
// leaves 22 bits for a depth; sums of 32-bit floats would have lost most of those by the far corner of the map.
const int mostOfBlock = 32;
const float unit = 4194303.0;  // 2²² − 1

/// Depth in [0, 1] and its square.
uvec2 momentsOf(float depth) {
    return uvec2(round(unit * vec2(depth, depth * depth)));
}

/// Of all texels before this corner along x and y.
uvec2 sumBefore(usampler2D sums, ivec2 corner) {
    return any(lessThan(corner, ivec2(1))) ? uvec2(0) : texelFetch(sums, corner - 1, 0).rg;
}

/// From `low` to `high` along one axis, in texels: the texels at both ends, which count in part, and blocks of those between.
struct Spans {
    float low, high;
    int first, last, count;
};

Spans spansBetween(float low, float high, int size) {
    int first = clamp(int(floor(low)), 0, size - 1), last = clamp(int(floor(high)), first, size - 1);
    int blocks = (last - first - 1 + mostOfBlock - 1) / mostOfBlock;
    return Spans(low, high, first, last, first == last ? 1 : blocks + 2);
}

/// Where span `i` begins.
int beginOf(Spans s, int i) {
    if (i == 0) return s.first;
    return i == s.count ? s.last + 1 : min(s.first + 1 + (i - 1) * mostOfBlock, s.last);
}

float weightOf(Spans s, int i) {
    if (s.count == 1) return s.high - s.low;
    if (i == 0) return float(s.first + 1) - s.low;
    return i == s.count - 1 ? s.high - float(s.last) : 1.0;
}

/// The means of depth and its square over a rectangle between two corners, in texels.
vec2 meanMoments(usampler2D sums, vec2 low, vec2 high) {
    ivec2 size = textureSize(sums, 0);
    low = clamp(low, vec2(0.0), vec2(size));
    high = clamp(high, vec2(0.0), vec2(size));
    Spans across = spansBetween(low.x, high.x, size.x), along = spansBetween(low.y, high.y, size.y);
    vec2 total = vec2(0.0);
    for (int y = 0; y < along.count; ++y) {
        int bottom = beginOf(along, y), top = beginOf(along, y + 1);
        uvec2 before = sumBefore(sums, ivec2(across.first, top)) - sumBefore(sums, ivec2(across.first, bottom));
        for (int x = 0; x < across.count; ++x) {
            int right = beginOf(across, x + 1);
            uvec2 after = sumBefore(sums, ivec2(right, top)) - sumBefore(sums, ivec2(right, bottom));
            total += weightOf(across, x) * weightOf(along, y) * vec2(after - before);
            before = after;
        }
    }
    return total / (unit * (high.x - low.x) * (high.y - low.y));
}
