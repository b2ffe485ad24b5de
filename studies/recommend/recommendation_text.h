// Recommendations as people and machines read them.
#pragma once

#include "studies/recommend/recommendation.h"

#include <string>
#include <vector>

namespace shadowbench::recommend {

/// Plain text for a terminal.
std::string text(const Recommendation& recommendation);

/// Of several scenes: the one technique for all.
std::string commonText(const Recommendations& all);

/// A JSON list of one object a scene: "scene", "casters" with the recommended level of every group, errors by both oracles
/// and "verified", "technique", "map", "samples". Errors are named by metric; triangles are those of one instance unless
/// said otherwise; distances in metres, "until" absent without end. Of several scenes a last object holds "scenes" and the
/// one "technique" for all, null if there is none.
std::string json(const Recommendations& all);

} // namespace shadowbench::recommend
