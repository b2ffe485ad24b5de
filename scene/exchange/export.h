// A scene as files that any renderer reads, docs/exchange.md: glTF 2.0, OBJ, JSON, and a scene file that gives it back.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
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

/// The files that an export's `scene.json` names beside itself, by the text of that; none where it is no such text. Throws
/// BadInput beyond the limits of base/json_text.h.
std::vector<std::string> exportedFiles(std::string_view description);

} // namespace shadowbench::exchange
