// Light space perspective shadow map (Wimmer, Scherzer, Purgathofer 2004), Scherzer 2.2.2. The warp is in
// shared/light_views/lispsm_view.cpp. Departure: the body that the map is focused on is the scene's bounding box clipped by
// the view frustum; casters between it and the light are kept by depth clamping instead of growing the body towards the
// light, which leaves all of the depth range to receivers.
#include "techniques/contract/entry.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {

Entry smLispsm() {
    return {.id = "sm-lispsm",
            .title = "Light space perspective shadow map",
            .source = {Document::Dissertation, "2.2.2"},
            .answer = Answer::Hard,
            .parameters = singleMapParameters(),
            .variants = {""},
            .make = [](const Parameters& p) { return makeSingleMap(p, lispsmView); }};
}

} // namespace shadowbench::techniques
