// Files that the same command makes again.
#pragma once

#include <filesystem>
#include <string_view>

namespace shadowbench::site {

/// As writeFile of base/files.h, whole or not at all, but without waiting for the disk: a site has hundreds of files, and
/// after a crash it is made again. Throws InternalError naming the file when it cannot be written.
void writeMade(const std::filesystem::path& file, std::string_view content);

} // namespace shadowbench::site
