// Where the operators find something to change in a C++ file, by libclang.
#pragma once

#include "tools/mutants/operators/point.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::mutants {

/// The compiler's words for `file` that its syntax hangs on, from the compile_commands.json in `build`.
std::vector<std::string> syntaxFlags(const std::filesystem::path& build, const std::filesystem::path& file);

/// All points of `source`; what the compiler evaluates is left out where that is easily seen.
std::vector<Point> pointsOf(const std::string& source, const std::vector<std::string>& flags);

/// Offsets into `source` of what does not compile, with the notes that go with it.
std::vector<std::size_t> errorsOf(const std::string& source, const std::vector<std::string>& flags);

} // namespace shadowbench::mutants
