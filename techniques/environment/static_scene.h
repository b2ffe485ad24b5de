// What precomputation asks of a scene.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace shadowbench::techniques {

/// Surfaces must stand still: what is known of them was computed before the first frame. Camera and light may move.
std::optional<std::string> movingSurfaces(const Scene& scene);

} // namespace shadowbench::techniques
