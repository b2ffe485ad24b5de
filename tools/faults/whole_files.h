// Whether a file is whole, by what its format says of its own end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace shadowbench::faults {

/// What is partial about the file; nothing if it is whole, or of a kind that does not say.
std::optional<std::string> partial(const std::filesystem::path& file);

} // namespace shadowbench::faults
