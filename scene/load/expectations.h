// What is expected of techniques on several scenes: expect.toml of a technique folder (docs/technique-folders.md).
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

struct SceneExpectations {
    std::string scene; // as loadScene takes it
    std::vector<Expectation> expectations;
};

/// `[[expect]]` entries, each a scene with lists as `[expect]` of scene files has them, in the gate profile. `file` is named
/// in errors, and scenes that are not built in lie beside it. `metrics`: as of loadScene. Throws BadInput with file, line
/// and key.
std::vector<SceneExpectations> parseExpectations(std::string_view toml, const std::filesystem::path& file,
                                                 const std::vector<std::string>& metrics);

} // namespace shadowbench
