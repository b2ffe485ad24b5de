// What techniques over depth maps need at least (techniques/contract/bare.h).
#pragma once

#include "techniques/contract/bare.h"
#include "techniques/contract/technique.h"
#include "techniques/shared/light_views/light_view.h"

#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// How often a receiver's pixel reads the map, in the pass `lookup`, and what asks for it.
struct MapReads {
    Read read;
    int count;
    std::string source;
    std::string_view lookup = "resolve";
};

/// The casters into a map of `side`² depths, and the reads of it.
std::vector<BarePass> bareMappedShadow(const Frame& frame, const LightView& light, int side, MapReads reads);

} // namespace shadowbench::techniques
