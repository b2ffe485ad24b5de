// glTF 2.0: writing a scene's scored frame, and reading a scene.
#pragma once

#include "scene/exchange/parts.h"

#include <filesystem>
#include <optional>
#include <string>

namespace shadowbench::exchange {

/// A .gltf and the buffer that it names, `scene.bin`.
struct GltfFiles {
    std::string gltf, bin;
};

/// The scene at `frame`: a mesh for each part, a node for each instance, the camera and the light.
GltfFiles gltfOf(const Scene& scene, const Snapshot& frame, const Parts& parts);

/// What a .gltf says of a scene.
struct SceneOfGltf {
    std::string id; // that it was exported under, else the file's name
    /// The scene file that the export has written beside it, if it is there: it holds what moves, too.
    std::optional<std::filesystem::path> beside;
    /// Else a scene file's text: the meshes where the nodes put them, the one camera and the one light, at rest. Of our own
    /// exports camera and light are those of the extras, to the last digit; others have a point or directional light.
    std::string toml;
};

/// Throws BadInput naming the file and what is wrong with it.
SceneOfGltf sceneOfGltf(const std::filesystem::path& file);

} // namespace shadowbench::exchange
