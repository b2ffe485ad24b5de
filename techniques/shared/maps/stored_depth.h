// What the map of a filtered shadow holds: nearest depths, or midpoints (Zápotocký 4.4.2: his methods with /b/ and /m/).
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/linearised_map.h"

#include <memory>

namespace shadowbench::techniques {

Parameter storedDepthParameter(); // `depth`

/// The map that `depth`, `map` and the bias's parameters ask for. Midpoints are drawn without a bias.
std::unique_ptr<ShadowMap> storedDepthMap(const Parameters& parameters, Lookup lookup);

/// The same, read as linear depth.
LinearisedMap storedLinearisedMap(const Parameters& parameters);

} // namespace shadowbench::techniques
