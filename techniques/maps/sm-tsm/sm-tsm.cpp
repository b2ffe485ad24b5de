// Trapezoidal shadow map (Martin, Tan 2004). Scherzer 2.2.2, which names the method and its heuristic near plane; the 80 %
// rule and the trapezoid are the paper's. The fit is in tsm_view.cpp. Departures: the trapezoid bounds the visible part
// of the scene's box, not the whole view frustum, and its sides are those of that body's bounding rectangle after the warp;
// depth is divided by the same w as x and y, where the paper keeps it apart so that a constant bias means the same
// everywhere.
#include "techniques/contract/entry.h"
#include "techniques/maps/sm-tsm/tsm_view.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {

Entry smTsm() {
    std::vector<Parameter> parameters = withNormalOffset(withDepthMapParameters(
        {{"focus", "0.5", RealRange{0.01, 1},
          "share of the visible depth that takes four fifths of the map; 0.8 and more: no warp", "Martin, Tan 2004"}}));
    return {.id = "sm-tsm",
            .title = "Trapezoidal shadow map",
            .source = {Document::Dissertation, "2.2.2, Warping"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) {
                return makeSingleMap(p, [focus = p.real("focus")](const Frame& frame) {
                    return fitTsm(frame.hardLight, frame.snapshot, frame.snapshot.camera, frame.aspect(), focus);
                });
            }};
}

} // namespace shadowbench::techniques
