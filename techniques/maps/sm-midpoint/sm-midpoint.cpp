// Midpoint shadow map (Woo 1992) over the uniform light frustum: no bias at all. Course, "Bias" (Second Depth Shadow Maps);
// Zápotocký 4.4.2. The paper's second depth is the next surface; `second=backface` is Zápotocký's pair of front and back
// faces, which is the same on closed meshes that do not meet, and loses the shadow of open ones.
#include "techniques/contract/entry.h"
#include "techniques/shared/maps/midpoint_map.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {

Entry smMidpoint() {
    return {.id = "sm-midpoint",
            .title = "Midpoint shadow map",
            .source = {Document::Course, "Bias; Zápotocký 4.4.2"},
            .answer = Answer::Hard,
            .parameters = {mapParameter(),
                           {"second", "surface", OneOf{{"surface", "backface"}},
                            "what the nearest depth is averaged with: the next surface, or front with back faces",
                            "course, Bias; Zápotocký 4.4.2"}},
            .variants = {""},
            .make = [](const Parameters& p) {
                const SecondDepth second = p.text("second") == "surface" ? SecondDepth::Surface : SecondDepth::BackFace;
                return makeSingleMap(std::make_unique<MidpointMap>(p.integer("map"), Lookup::Compare, second), uniformView);
            }};
}

} // namespace shadowbench::techniques
