// Back projection over depth-peeled layers (Bavoil et al. 2008): occluders that the nearest layer hides from the light's
// centre, but not from all of the light, are in the layers behind it. Scherzer 2.3.4.
//
// 1. `layers` maps are peeled from the light's centre, a pass each.
// 2. The microquads of each layer are projected back onto the light as in bitmask soft shadows.
// 3. The bits of all layers are OR'd.
//
// Departures: microquads take the place of the paper's texels, since our sources say no more of it than its layers; the
// layers behind the first hold only surfaces that face the light, so that two layers reach two closed meshes and not the two
// sides of one; where a layer has no occluder at a corner, the last one of the layers before it stands in, without which a
// gap opens where a surface passes from one layer to the next.
//
// It fails behind more occluders than layers, and each layer costs its pass and its search.
#include "techniques/contract/entry.h"
#include "techniques/shared/maps/peeled_map.h"
#include "techniques/soft/microquad_technique.h"

#include <memory>

namespace shadowbench::techniques {

Entry backprojectionPeeled() {
    std::vector<Parameter> own = microquadParameters();
    own.insert(own.begin(), {"layers", "2", IntegerRange{1, PeeledMap::most}, "peeled from the light's centre, a pass each",
                             "dissertation, 2.3.4"});
    return {.id = "backprojection-peeled",
            .title = "Back projection over depth-peeled layers",
            .source = {Document::Dissertation, "2.3.4"},
            .answer = Answer::Soft,
            .notApplicable = lightWithoutSurface,
            .parameters = withDepthMapParameters(std::move(own)),
            .contradiction = moreSamplesThanBits,
            .figures = {{"quads", "microquads that a receiver's pixel projects onto the light, of all layers, in the mean"}},
            .variants = {"", "window=12,samples=256,bits=256"},
            .make = [](const Parameters& p) {
                const int layers = p.integer("layers");
                return std::make_unique<MicroquadTechnique<PeeledMap>>(p, layers,
                                                                       PeeledMap(p.integer("map"), layers, biasFrom(p)));
            }};
}

} // namespace shadowbench::techniques
