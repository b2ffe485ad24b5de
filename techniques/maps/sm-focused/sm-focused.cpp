// Focused shadow map (Brabec, Annen, Seidel 2002): the map holds only what the camera sees of the scene. Scherzer 2.2,
// Fig. 2.5; course, "Extensions". The fit is in shared/light_views/focused_view.cpp. Departure: B is not grown towards the
// light to take in casters; depth clamping keeps them, which leaves all of the depth range to receivers.
#include "techniques/contract/entry.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {

Entry smFocused() {
    return {.id = "sm-focused",
            .title = "Shadow map, focused",
            .source = {Document::Dissertation, "2.2, Fig. 2.5"},
            .answer = Answer::Hard,
            .parameters = singleMapParameters(),
            .variants = {""},
            .make = [](const Parameters& p) { return makeSingleMap(p, focusedView); }};
}

} // namespace shadowbench::techniques
