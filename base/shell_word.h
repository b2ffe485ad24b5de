// Words of commands that people copy, or that a shell runs.
#pragma once

#include <string>

namespace shadowbench {

/// The word as a POSIX shell takes it: in quotes unless it is plain.
std::string shellWord(const std::string& word);

} // namespace shadowbench
