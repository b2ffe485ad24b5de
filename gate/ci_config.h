// What `shadowbench ci` judges, as the judged repository says it: shadowbench.toml (docs/ci.md).
#pragma once

#include "gate/gate_config.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::gate {

inline constexpr const char* usualConfig = "shadowbench.toml";

struct CiConfig {
    std::string build;                            // a line for the shell; "": nothing is built
    std::vector<std::filesystem::path> renderers; // files, from the repository's root
    std::vector<std::string> scenes;              // ids, or files from the root; empty: the standard scenes
    Profile profile = Profile::Gate;
    std::vector<std::string> techniques{"external:*"}; // patterns
    GateConfig judged;                                 // bounds and waivers

    /// All files that it names, and itself, from the root.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

    std::filesystem::path file; // from the root
};

/// The file of a tree whose root is `root`. Throws BadInput with file, line and key for an unknown key, a wrong value and a
/// file that is not there.
CiConfig readCiConfig(const std::filesystem::path& root, const std::filesystem::path& file);

} // namespace shadowbench::gate
