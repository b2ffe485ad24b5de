// Technique folders to begin with, which the program carries in itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// "history", "pcf", "shadow-map", "vsm".
std::vector<std::string> folderTemplates();

/// Writes the template `like` as a new folder whose id is `id`; returns its files. Throws BadInput for an id or a template
/// that is none, and where anything is at `folder` already.
std::vector<std::filesystem::path> writeFromTemplate(const std::string& like, const std::string& id,
                                                     const std::filesystem::path& folder);

} // namespace shadowbench::techniques
