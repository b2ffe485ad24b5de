// The files of an exported scene that are text and no glTF.
#pragma once

#include "scene/exchange/parts.h"

#include <string>
#include <vector>

namespace shadowbench::exchange {

/// `scene.obj`: each part as a group in its own space, and the colours for `scene.mtl`.
std::string objOf(const Parts& parts);
std::string mtlOf(const Parts& parts);

/// The names of an export's files that scene.json mentions.
struct FileNames {
    std::string toml;
    std::string cards; // the glTF file with cards and their masks; empty where no mesh has any
    std::vector<std::string> all;
};

/// `scene.json`: size, conventions, meshes and the given frames, the scored one first.
std::string sceneJsonOf(const Scene& scene, const Parts& parts, const std::vector<int>& frames, const FileNames& files);

/// The scene file that gives `scene` back, its meshes taken from `scene.gltf` and its sky from `sky.exr`.
std::string tomlOf(const Scene& scene, const Parts& parts);

} // namespace shadowbench::exchange
