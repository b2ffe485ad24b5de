// A scene as files that any renderer reads, docs/exchange.md: glTF 2.0, OBJ, JSON, and a scene file that gives it back.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::exchange {

/// What an export has written.
struct Exported {
    std::vector<std::string> files; // names within the folder, `scene.json` last
    std::vector<int> frames;        // those that scene.json describes, the scored one first
};

/// Writes `scene` into `folder`, which is made if need be: all files or none. Those of an earlier export into the same
/// folder are replaced. Throws BadInput where the folder holds other files or is none, and InternalError where a file
/// cannot be written.
Exported exportScene(const Scene& scene, const std::filesystem::path& folder);

} // namespace shadowbench::exchange
