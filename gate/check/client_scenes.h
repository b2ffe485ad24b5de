// The six scenes on which a client's adapter is checked: small images, each of what adapters get wrong.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace shadowbench::gate {

/// hands: a point light and blocks that look the same from no other side. sun: a directional light over a scene of hundreds
/// of metres. moving: blocks, camera and light move. contact: wide lit faces, and thin plates just above them. sheets: open
/// meshes that face the light, and that face away from it. soft: a large area light near its receivers.
std::vector<Scene> clientScenes();

} // namespace shadowbench::gate
