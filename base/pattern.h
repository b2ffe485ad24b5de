// Regular expressions of the C library: files that include <regex> take seconds longer to compile, and it recurses by the
// character.
#pragma once

#include <string>
#include <vector>

namespace shadowbench {

/// The first match of `pattern`, an extended regular expression of POSIX (with GNU's \b and \w), in `text`, and after it
/// what its groups hold; empty where nothing matches.
std::vector<std::string> firstMatch(const std::string& text, const std::string& pattern);

} // namespace shadowbench
