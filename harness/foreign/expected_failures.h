// Failures of renderers that `check` knows and forgives: [[expect]] of a list of renderers (docs/external.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::foreign {

/// Rows that fail on a scene of `check`.
struct ExpectedFailure {
    std::string scene;
    std::vector<std::string> renderers; // ids, or globs over ids
    std::string says;                   // part of what `check` says of them: another failure is none that is known
    std::string reason;
    std::string where; // "file:line: key", for errors

    [[nodiscard]] bool covers(const std::string& scene, const std::string& renderer) const;
};

/// Those of a file, in its order. Throws BadInput naming file, line and key of what is wrong, missing or unknown.
std::vector<ExpectedFailure> readExpectedFailures(const std::filesystem::path& file);

} // namespace shadowbench::foreign
