// Bitmask soft shadows (Schwarz and Stamminger 2007): microquads between the texel centres of one shadow map from the
// light's centre are the occluders. Scherzer 2.3.4, Fig. 4.3.
//
// 1. A min/max pyramid of the map bounds the region that can hide light from a receiver.
// 2. Four texel centres in front of the receiver are the corners of a microquad, which is projected back onto the light.
// 3. The samples of the light behind it are set in a field of bits, so that what several microquads hide counts once.
// 4. The bits that are not set are the visible share of the light.
//
// Fig. 4.3 compares search areas of 8 × 8 and 12 × 12: `window` microquads per side at most, between squares of texels of
// the pyramid's level that allows it, each as deep as what is nearest in it.
//
// Departures: `window=all` takes every texel of areas up to 192 across, squares of the pyramid whose depths hardly differ as
// one quad (`flat`); samples in rows, so that a quad hides runs of bits; texels beside the receiver's own are compared with
// the receiver's plane, and squares of them with where it is nearest (bias=slope); a rectangle whose sides are not quite at
// right angles is taken for that of the same sides.
//
// It fails where the papers say so: what the map's one layer does not hold does not occlude; small windows see squares of
// texels, the larger the light, and near contact nothing smaller than those; and since a microquad needs all its corners,
// edges lie half a texel inside the occluder.
#include "techniques/contract/entry.h"
#include "techniques/shared/maps/linear_depth_map.h"
#include "techniques/soft/microquad_technique.h"

#include <memory>

namespace shadowbench::techniques {

Entry bitmask() {
    return {.id = "bitmask",
            .title = "Bitmask soft shadows",
            .source = {Document::Dissertation, "2.3.4, Fig. 4.3"},
            .answer = Answer::Soft,
            .notApplicable = lightWithoutSurface,
            .parameters = withDepthMapParameters(microquadParameters()),
            .contradiction = moreSamplesThanBits,
            .figures = {{"quads", "microquads that a receiver's pixel projects onto the light, in the mean"}},
            .variants = {"", "window=12,samples=256,bits=256", "window=all,samples=256,bits=256"},
            .make = [](const Parameters& p) {
                return std::make_unique<MicroquadTechnique<LinearDepthMap>>(p, 1,
                                                                            LinearDepthMap(p.integer("map"), biasFrom(p)));
            }};
}

} // namespace shadowbench::techniques
