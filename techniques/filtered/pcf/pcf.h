// Percentage-closer filtering as a part of other techniques.
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"
#include "techniques/shared/maps/depth_map.h"

#include <memory>
#include <vector>

namespace shadowbench::techniques {

/// `depth`: what the map of a filtered shadow holds.
Parameter storedDepthParameter();

/// The map that `depth`, `map` and the bias's parameters ask for.
std::unique_ptr<ShadowMap> storedDepthMap(const Parameters& parameters, Lookup lookup);

/// `kernel`, `depth`, `map`, `bias` (with `normal-offset`), `factor` and `units`.
std::vector<Parameter> pcfParameters();

/// `pcf` with these parameters.
std::unique_ptr<Technique> makePcf(const Parameters& parameters);

} // namespace shadowbench::techniques
