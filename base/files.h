// Files are written whole or not at all: temporary name in the same folder, fsync, rename.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

/// Writes `content` to `file`, replacing it atomically; makes missing parent folders. Throws InternalError with the reason
/// (full disk, no permission) and leaves neither the temporary file nor a partial one.
void writeFile(const std::filesystem::path& file, std::string_view content);

/// The same for a library that writes by name: `write` is given the temporary path, which keeps `file`'s extension.
void writeFileWith(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

/// The whole file. Throws BadInput naming the file and the reason when it cannot be read.
std::string readFile(const std::filesystem::path& file);

/// The near matches of `word` among `known` (edit distance), to follow the wrong word in an error message: ` (did you mean
/// "pcss"?)`, or nothing.
std::string didYouMean(std::string_view word, const std::vector<std::string>& known);

} // namespace shadowbench
