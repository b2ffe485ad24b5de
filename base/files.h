// Files are written whole or not at all: temporary name in the same folder, fsync, rename, fsync of the folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace shadowbench {

/// Writes `content` to `file`, replacing it atomically; makes missing parent folders. Once it returns, the file outlives a
/// power cut. Throws InternalError with the reason (full disk, no permission) and leaves neither the temporary file nor a
/// partial one; an interrupt waits for that. A process that is killed leaves the temporary file (isTemporary), which the
/// next process that writes into the folder removes.
void writeFile(const std::filesystem::path& file, std::string_view content);

/// The same for a library that writes by name: `write` is given the temporary path, which keeps `file`'s extension.
void writeFileWith(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

/// As writeFile but without fsync, for output that can be made again: it need not survive a power cut.
void writeFileUnflushed(const std::filesystem::path& file, std::string_view content);

/// Makes the folder and those above it that are missing, so that they outlive a power cut, and returns these, the deepest
/// first.
std::vector<std::filesystem::path> makeFolders(const std::filesystem::path& folder, std::error_code& failed);

/// Whether `file` has the name of one that is being written, or was when its writer was killed:
/// `.NAME.shadowbench-XXXXXX.EXT`.
bool isTemporary(const std::filesystem::path& file);

/// The whole file. Throws BadInput naming the file and the reason when it cannot be read.
std::string readFile(const std::filesystem::path& file);

} // namespace shadowbench
