// Reasons for which several techniques have nothing to do on a scene (Entry::notApplicable).
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace shadowbench::techniques {

/// The light must be somewhere: not a directional one.
std::optional<std::string> lightWithoutPosition(const Scene& scene);

} // namespace shadowbench::techniques
