// Asking git about a repository.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

/// The lines that `git <arguments>` prints in `folder`; nothing if it fails or there is no git.
std::optional<std::vector<std::string>> git(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// The first of those lines; "" without any.
std::string firstLine(const std::optional<std::vector<std::string>>& lines);

} // namespace shadowbench
