// glTF 2.0: writing a scene's scored frame, and reading a scene.
#pragma once

#include "scene/exchange/parts.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::exchange {

/// The files of a glTF, by name.
using GltfFiles = std::vector<std::pair<std::string, std::string>>;

/// Meshes that an alpha test leaves of cards: as the triangles that are left, or as the cards, for engines that test alpha
/// themselves.
enum class Holes { Cut, Masked };

/// The scene at `frame`: a mesh for each part, a node for each instance, the camera and the light. `name`.bin, the PNGs of
/// masks, and `name`.gltf.
GltfFiles gltfOf(const Scene& scene, const Snapshot& frame, const Parts& parts, const std::string& name, Holes holes);

/// What a scene file that names a glTF file says of it.
struct GltfUse {
    std::string file;                             // as the scene file names it
    std::optional<std::string> camera{}, light{}; // of the file, by name
    bool hasCamera = false, hasLight = false;     // the scene file has its own, and those of the glTF file do not matter
    double metres = 1;                            // of the glTF file's unit
    bool zUp = false;
    int maskTexels = 0; // per side of a mask at most; 0: as its texture has
};

/// What a .gltf or .glb says of a scene.
struct SceneOfGltf {
    std::string id; // that it was exported under, else the file's name
    /// The scene file that the export has written beside it, if it is there: it holds what moves, too.
    std::optional<std::filesystem::path> beside;
    /// Else a scene file's text: an object for each primitive where the nodes put it, a camera and a light unless `use` has
    /// them, at rest. Of our own exports camera and light are those of the extras, to the last digit; others have a point or
    /// directional light.
    std::string toml;
};

/// Throws BadInput naming the file, what is wrong with it and what to write or export instead.
SceneOfGltf sceneOfGltf(const std::filesystem::path& file, const GltfUse& use);

} // namespace shadowbench::exchange
