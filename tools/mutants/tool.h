// External programs of the suite: git, CMake, CTest and the program with a fault in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::mutants {

/// What a program printed, and whether it exited with 0.
struct ToolResult {
    bool succeeded = false;
    std::vector<std::string> lines;

    /// The line that says best what went wrong: a failed test, else the first that complains, else the last one.
    [[nodiscard]] std::string complaint() const;
};

/// Runs a program to its end in `folder`, with our own home (compilers' caches) and at low priority. Throws Inconclusive
/// when there is no such program.
ToolResult tryTool(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const std::filesystem::path& folder);

/// The lines that it printed; throws InternalError, with its complaint, when it fails.
std::vector<std::string> runTool(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const std::filesystem::path& folder);

} // namespace shadowbench::mutants
