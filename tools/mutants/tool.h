// External programs of the suite: git, CMake and the program with a fault in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::mutants {

/// Runs a program to its end in `folder`, with our own home (compilers' caches) and at low priority; the lines that it
/// printed. Throws Inconclusive when there is no such program and InternalError, with its first complaint, when it fails.
std::vector<std::string> runTool(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const std::filesystem::path& folder);

} // namespace shadowbench::mutants
