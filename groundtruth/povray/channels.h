// A run of POV-Ray, whatever the lights of the scene.
#pragma once

#include "groundtruth/povray/povray.h"

#include <string>

namespace shadowbench::groundtruth::povray {

/// Linear values in [0, 1]; the hit mask has been taken off blue, which ends at hitMask (groundtruth/povray/scene_text.h).
struct Channels {
    Image<float> red, green, blue;
    Image<std::uint8_t> hit; // 1 where the ray hits something
};

/// Renders a scene text; the recipe of the options does not matter. Throws as `render`.
Channels renderChannels(const std::string& text, glm::ivec2 size, const Options& options, const Progress& progress);

} // namespace shadowbench::groundtruth::povray
