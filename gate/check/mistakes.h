// What an adapter's mistakes draw: the snapshot that it would have taken the exported one for.
#pragma once

#include "scene/snapshot.h"

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct Mistake {
    std::string sentence; // "its field of view is taken for the horizontal one"
    /// The snapshot as it is drawn with the mistake; `scored` is the one of the scored frame. Nothing where that is no
    /// snapshot.
    std::function<std::optional<Snapshot>(const Snapshot& shown, const Snapshot& scored, glm::ivec2 size)> taken;
};

/// Those of camera, light and meshes. Mistakes of rows, encodings and frames are harness/foreign/recognition.h's.
const std::vector<Mistake>& mistakes();

} // namespace shadowbench::gate
