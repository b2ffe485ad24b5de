// glTF 2.0 of a scene's scored frame.
#pragma once

#include "scene/exchange/parts.h"

#include <string>

namespace shadowbench::exchange {

/// A .gltf and the buffer that it names, `scene.bin`.
struct GltfFiles {
    std::string gltf, bin;
};

/// The scene at `frame`: a mesh for each part, a node for each instance, the camera and the light.
GltfFiles gltfOf(const Scene& scene, const Snapshot& frame, const Parts& parts);

} // namespace shadowbench::exchange
