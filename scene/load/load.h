// Scenes by name: built-in ones and files.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

/// Loads a built-in scene by id, a file by path (TOML, or glTF 2.0), or an exported scene by its folder. `metrics` are the
/// names that `[tolerance]` and `[expect]` may put bounds on; empty: any, for callers that do not read bounds. Errors
/// (BadInput) name file, line and key, and near matches for an unknown id, key or metric.
Scene loadScene(const std::string& idOrFile, Profile profile, const std::vector<std::string>& metrics = {});

/// Parses TOML text; `file` is used for the id, for error messages and to resolve mesh files.
Scene parseScene(std::string_view toml, const std::filesystem::path& file, Profile profile,
                 const std::vector<std::string>& metrics = {});

/// Ids of the five standard scenes, in the order tables print them: what a run without `--scene` renders.
std::vector<std::string> standardScenes();

/// Ids of all built-in scenes, the standard ones first, and the text of one.
std::vector<std::string> builtinScenes();
std::string_view builtinSceneText(const std::string& id);

/// Throws BadInput when the set-up has no defined answer: light on a surface, zero-size area light, eye inside a closed
/// mesh.
void requireWellPosed(const Scene& scene);

/// A placement (Placement::id) that the frame's light touches, or comes as near to as `distance` metres.
std::optional<std::uint32_t> surfaceAtLight(const Snapshot& frame, double distance);

} // namespace shadowbench
