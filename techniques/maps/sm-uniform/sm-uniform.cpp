// Shadow map (Williams 1978) with the light frustum fitted to the whole scene: the baseline of everything.
// Course, "Shadow Mapping"; Scherzer 2.2; Zápotocký 2.3.
#include "techniques/contract/entry.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {

Entry smUniform() {
    return {.id = "sm-uniform",
            .title = "Shadow map, uniform",
            .source = {Document::Course, "Shadow Mapping"},
            .answer = Answer::Hard,
            .parameters = singleMapParameters(),
            .variants = {""},
            .make = [](const Parameters& p) { return makeSingleMap(p, uniformView); }};
}

} // namespace shadowbench::techniques
