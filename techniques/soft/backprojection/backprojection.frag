// The areas that the map's texels hide of the light, summed.
#include "gl/receiver.glsl"
#include "shared/filters/back_projection.glsl"
#include "soft/backprojection/texel_quad.glsl"

uniform sampler2D normals;
uniform sampler2D linearDepth;  // negative: moving caster
uniform int widest;             // texels per side of the search area, at most

out float visibility;

struct Sum {
    float hidden;  // share of the light; texels that overlap on it count twice
    float quads;   // back-projected
};

/// 1 / depth of a texel; 0 where it does not occlude the receiver.
float occluder(ivec2 texel, LightReceiver r) {
    if (any(greaterThanEqual(texel, ivec2(mapSide)))) return 0.0;
    float inverse = 1.0 / abs(texelFetch(linearDepth, texel, 0).r);
    return occludes(inverse, r, offsetOf(vec2(texel) + 0.5, r)) ? inverse : 0.0;
}

/// The quad of `size` × `size` texels of one depth, that of the texel `middle` further on.
void addQuad(inout Sum sum, ivec2 texel, int size, int middle, LightReceiver r) {
    float own = occluder(texel + middle, r);
    if (own == 0.0) return;
    vec2 lowOffset = offsetOf(vec2(texel), r);
    vec2 highOffset = offsetOf(vec2(texel + size), r);
    vec2 low = onLight(lowOffset, own, r);
    vec2 high = onLight(highOffset, own, r);
#if FILL_GAPS
    float right = occluder(texel + middle + ivec2(size, 0), r);
    float above = occluder(texel + middle + ivec2(0, size), r);
    if (right > 0.0) high.x = upToNeighbour(high.x, onLight(highOffset, right, r).x);
    if (above > 0.0) high.y = upToNeighbour(high.y, onLight(highOffset, above, r).y);
#endif
    sum.hidden += shareOfLight(low, high);
    sum.quads += 1.0;
}

void addRoot(inout Sum sum, ivec2 root, Roots roots, LightReceiver r) {
    int middle = (1 << roots.finest) >> 1;
    for (Walk walk = walkFrom(root, roots.level); !finished(walk) && sum.hidden < 1.0;) {
        int verdict = judged(walk, roots.finest, 0, r);
        Quads quads = quadsOf(walk, verdict);
        for (int i = 0; i < quads.count; ++i)
            addQuad(sum, firstTexel(walk) + quads.size * ivec2(i & 1, i >> 1), quads.size, middle, r);
        walk = stepped(walk, verdict == lookInto);
    }
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    LightReceiver r = lightReceiver(receiver.position, normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz));
    Roots roots = rootsOf(searchArea(0, r), widest);
    Sum sum = Sum(0.0, 0.0);
    for (int y = roots.first.y; y <= roots.last.y; ++y)
        for (int x = roots.first.x; x <= roots.last.x; ++x) addRoot(sum, ivec2(x, y), roots, r);
#if COUNT_QUADS
    visibility = sum.quads;
#else
    visibility = 1.0 - min(sum.hidden, 1.0);
#endif
}
