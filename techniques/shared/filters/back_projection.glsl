// Back projection of what a shadow map holds onto the light, as a receiver sees it (Scherzer 2.3.4). A point of the map `offset` beside
// the receiver and at depth z is seen on the light at offset · span / (1/z − 1/r), in metres from the light's centre, where r is the
// receiver's depth and span the map's at unit depth.
#include "shared/maps/light_receiver.glsl"
#include "shared/maps/min_max_pyramid.glsl"

uniform vec2 lightScale;  // span of the map at unit depth over half the light's sides
uniform float flatness;

const float farthest = 1e-5;  // of 1/z − 1/r: what lies no nearer to the light than the receiver is seen at the horizon

vec2 offsetOf(vec2 texels, LightReceiver r) {
    return texels * (1.0 / float(mapSide)) - r.at;
}

/// 1 / (1/z − 1/r).
float magnificationOf(float inverseDepth, LightReceiver r) {
    return 1.0 / max(inverseDepth - 1.0 / r.depth, farthest);
}

/// Where the receiver sees that point: on a rectangular light if both coordinates are in [−1, 1].
vec2 onLight(vec2 offset, float inverseDepth, LightReceiver r) {
    return offset * lightScale * magnificationOf(inverseDepth, r);
}

/// The hard shadow test: what lies before the receiver's plane.
bool occludes(float inverseDepth, LightReceiver r, vec2 offset) {
    return inverseDepth > 1.0 / r.depth + dot(r.inverseSlope, offset);
}

/// The part of a map that can hide something of the light, in texels; nothing where high < low.
struct SearchArea {
    vec2 low, high;
};

/// Squares of 2^level texels whose centres enclose the area, as far as the map goes.
struct Cells {
    ivec2 low, high;
};

Cells cellsOf(SearchArea area, int level) {
    float size = float(1 << level);
    vec2 last = vec2((mapSide - 1) >> level);
    return Cells(ivec2(clamp(floor(area.low / size - 0.5), vec2(0.0), last + 1.0)),
                 ivec2(clamp(ceil(area.high / size - 0.5), vec2(-1.0), last)));
}

/// The light's projection from the receiver onto the depth of the nearest occluder within it, which is found step by step in the
/// pyramid.
SearchArea searchArea(int layer, LightReceiver r) {
    float own = 1.0 / r.depth;
    float nearest = nearestOfAll(layer);
    SearchArea area = SearchArea(vec2(0.0), vec2(-1.0));
    for (int i = 0; i < 3 && nearest > own; ++i) {
        vec2 reach = (nearest - own) / lightScale;
        area = SearchArea((r.at - reach) * float(mapSide), (r.at + reach) * float(mapSide));
        Cells texels = cellsOf(area, 0);
        nearest = nearestOver(layer, texels.low, texels.high);
    }
    if (nearest <= own || r.behind) area.high = area.low - 2.0;
    return area;
}

/// Nodes of the pyramid that walks begin at, of a level that needs few of them; none where last < first.
struct Roots {
    int level;
    ivec2 first, last;
    int finest;  // level of the smallest squares that are quads: 0 for single texels
};

/// `widest`: texels per side of the area, at most; of a wider one only every second is taken, or every fourth, …
Roots rootsOf(SearchArea area, int widest) {
    Cells cells = cellsOf(area, 0);
    ivec2 extent = cells.high - cells.low;
    int texels = max(extent.x, extent.y);
    int finest = findMSB(max(texels - 1, 0) / widest) + 1;
    int level = clamp(findMSB(texels) + 1, finest + 1, max(min(highestRoot, findMSB(pyramidSide)), finest + 1));
    return Roots(level, cells.low >> level, cells.high >> level, finest);
}

const int passOver = 0;     // nothing in the node hides anything of the light
const int takeWhole = 1;    // all of it hides light, at one depth: it is one quad
const int takeQuarters = 2; // its four parts are quads of the finest level
const int lookInto = 3;

/// What a node of the pyramid means to the receiver.
int judged(Walk walk, int finest, int layer, LightReceiver r) {
    ivec2 texel = firstTexel(walk);
    vec2 range = nodeRange(layer, walk.level, texel >> walk.level);
    vec2 low = offsetOf(vec2(texel), r);
    vec2 high = offsetOf(vec2(texel + (1 << walk.level) + 1), r);
    float own = 1.0 / r.depth;
    vec2 away = max(max(low, -high), vec2(0.0)) * lightScale;
    float plane = own + 0.5 * dot(r.inverseSlope, low + high);
    float spread = 0.5 * dot(abs(r.inverseSlope), high - low);
    if (range.x <= plane - spread || max(away.x, away.y) >= range.x - own) return passOver;

    bool even = range.x - range.y <= flatness * (range.y - own);
    if (even && range.y > plane + spread) return takeWhole;
    return walk.level == finest + 1 ? takeQuarters : lookInto;
}

/// The quads that a node is taken as: `count` squares of `size` texels, in Morton order.
struct Quads {
    int count, size;
};

Quads quadsOf(Walk walk, int verdict) {
    if (verdict == takeWhole) return Quads(1, 1 << walk.level);
    return Quads(verdict == takeQuarters ? 4 : 0, 1 << (walk.level - 1));
}
