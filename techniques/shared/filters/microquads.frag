// Bitmask soft shadows (shared/filters/microquads.h): the light samples that microquads hide, as bits.
#include "gl/receiver.glsl"
#include "shared/filters/back_projection.glsl"
#include "shared/sampling/light_samples.glsl"

uniform sampler2D normals;
uniform sampler2D linearDepth;  // LAYERS channels, nearest first; negative: moving caster
uniform float sampleCount;      // on the light

layout(std430, binding = 5) readonly buffer Outside { uint outside[WORDS]; };  // bits without a sample on the light

out float visibility;

struct Field {
    uint bits[WORDS];
    float quads;  // back-projected
};

/// A texel, or a square of 2^level texels, that may be the corner of microquads.
struct Corner {
    vec2 seenAt;  // its centre on the light
    bool blocks;
    bool fresh;   // in this layer; else the last occluder before it stands in
};

/// 1 / depth of what is nearest to the light in a square of texels.
float nearestIn(ivec2 cell, int level, int layer) {
#ifdef WINDOW
    if (level > 0) return nodeRange(layer, level, cell).x;
#endif
    return 1.0 / abs(texelFetch(linearDepth, min(cell, ivec2(mapSide - 1)), 0)[layer]);
}

Corner cornerAt(ivec2 cell, int level, int layer, LightReceiver r) {
    float size = float(1 << level);
    vec2 offset = offsetOf((vec2(cell) + 0.5) * size, r);
    // What is nearest in a square of the receiver's own plane lies before the plane's depth in its middle by so much.
    float slack = 0.5 * (size - 1.0) / float(mapSide) * dot(abs(r.inverseSlope), vec2(1.0));
    float last = 0.0;
    bool blocking = false;
    bool reached = false;
    for (int i = 0; i < LAYERS; ++i) {
        float inverse = nearestIn(cell, level, i);
        if (i > layer || !occludes(inverse - slack, r, offset)) continue;
        last = inverse;
        blocking = true;
        reached = i == layer;
    }
    return Corner(onLight(offset, last, r), blocking, reached);
}

/// A microquad is an occluder if all its corners are; in a further layer, only if that has not been said in the one before.
bool isOccluder(Corner a, Corner b, Corner c, Corner d) {
    return a.blocks && b.blocks && c.blocks && d.blocks && (a.fresh || b.fresh || c.fresh || d.fresh);
}

void hideRow(inout Field field, QuadEdges edges, ivec2 rows, int row) {
    uint run = row > rows.y ? 0u : runOfRow(edges, row) << (row * SAMPLES & 31);
    for (int i = 0; i < WORDS; ++i) field.bits[i] |= i == row * SAMPLES >> 5 ? run : 0u;
}

/// Sets the bits of the samples behind all four edges of an occluder. One that is folded, its corners on different occluders, may have
/// none: what it would hide is hidden by its neighbours.
void hide(inout Field field, Corner a, Corner b, Corner c, Corner d) {
    QuadEdges edges = edgesOf(a.seenAt, b.seenAt, c.seenAt, d.seenAt);
    ivec2 rows = isOccluder(a, b, c, d) ? rowsOf(edges) : ivec2(SAMPLES, -1);
    hideRow(field, edges, rows, rows.x);
    hideRow(field, edges, rows, rows.x + 1);
    for (int row = rows.x + 2; row <= rows.y; ++row) hideRow(field, edges, rows, row);
    field.quads += rows.y < 0 ? 0.0 : 1.0;
}

bool allHidden(Field field) {
    uint every = 0xffffffffu;
    for (int i = 0; i < WORDS; ++i) every &= field.bits[i];
    return every == 0xffffffffu;
}

#ifdef WINDOW
/// The finest level at which the area has no more than WINDOW × WINDOW microquads.
int levelOf(SearchArea area) {
    vec2 extent = max(area.high - area.low, vec2(0.0));
    int level = max(findMSB(int(max(extent.x, extent.y)) / WINDOW), 0);
    Cells cells = cellsOf(area, level);
    return any(greaterThan(cells.high - cells.low, ivec2(WINDOW))) ? level + 1 : level;
}

/// The microquads between squares of texels, each as deep as what is nearest in it.
void addOccluders(inout Field field, SearchArea area, int layer, LightReceiver r) {
    int level = levelOf(area);
    Cells cells = cellsOf(area, level);
    for (int y = cells.low.y; y < cells.high.y; ++y) {
        Corner a = cornerAt(ivec2(cells.low.x, y), level, layer, r);
        Corner d = cornerAt(ivec2(cells.low.x, y + 1), level, layer, r);
        for (int x = cells.low.x + 1; x <= cells.high.x; ++x) {
            Corner b = cornerAt(ivec2(x, y), level, layer, r);
            Corner c = cornerAt(ivec2(x, y + 1), level, layer, r);
            hide(field, a, b, c, d);
            a = b;
            d = c;
        }
    }
}
#else
/// Texels per side of the search area, at most. llvmpipe ends all loops of a pixel after 65,535 turns together: (192 / 2)² nodes with four
/// microquads each, and the nodes above them, stay below.
const int widest = 192;

void addRoot(inout Field field, ivec2 root, Roots roots, int layer, LightReceiver r) {
    for (Walk walk = walkFrom(root, roots.level); !finished(walk) && !allHidden(field);) {
        int verdict = judged(walk, roots.finest, layer, r);
        Quads quads = quadsOf(walk, verdict);
        for (int i = 0; i < quads.count; ++i) {
            ivec2 low = firstTexel(walk) + quads.size * ivec2(i & 1, i >> 1);
            ivec2 high = low + quads.size;
            Corner a = cornerAt(low, 0, layer, r);
            Corner b = cornerAt(ivec2(high.x, low.y), 0, layer, r);
            Corner c = cornerAt(high, 0, layer, r);
            Corner d = cornerAt(ivec2(low.x, high.y), 0, layer, r);
            hide(field, a, b, c, d);
        }
        walk = stepped(walk, verdict == lookInto);
    }
}

/// All microquads of the search area; of a very wide one, those between every second texel, or every fourth, …
void addOccluders(inout Field field, SearchArea area, int layer, LightReceiver r) {
    Roots roots = rootsOf(area, widest);
    for (int y = roots.first.y; y <= roots.last.y; ++y)
        for (int x = roots.first.x; x <= roots.last.x; ++x) addRoot(field, ivec2(x, y), roots, layer, r);
}
#endif

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    LightReceiver r = lightReceiver(receiver.position, normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz));
    Field field;
    field.quads = 0.0;
    for (int i = 0; i < WORDS; ++i) field.bits[i] = outside[i];
    for (int layer = 0; layer < LAYERS; ++layer) addOccluders(field, searchArea(layer, r), layer, r);
#ifdef COUNT_QUADS
    visibility = field.quads;
#else
    int open = 0;
    for (int i = 0; i < WORDS; ++i) open += bitCount(~field.bits[i]);
    visibility = float(open) / sampleCount;
#endif
}
