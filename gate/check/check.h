// `check`: what must hold of a technique folder's rows on any scene, and what the folder itself expects of them.
#pragma once

#include "base/error.h"

#include <filesystem>
#include <functional>
#include <string>

namespace shadowbench::gate {

struct CheckResult {
    std::string what;        // "my:evsm under a point light: the same bits twice"; empty: `note` is of no row alone
    std::string wrong;       // a sentence; empty: it holds
    std::string note = {};   // beside the outcome, such as figures of what holds; may be empty
    bool isExpected = false; // it is wrong, and known to be: `note` says why
};

/// Checks each row of the folder, which must be in the catalogue, and its expect.toml if there is one; `onResult` gets the
/// results in order. `cache`: of references, which expectations need. AccuracyRegression if something does not hold. Throws
/// BadInput with file and line for what cannot be read or compiled, and what `run` fails with.
ExitCode checkFolder(const std::filesystem::path& folder, const std::filesystem::path& cache,
                     const std::function<void(const CheckResult&)>& onResult);

} // namespace shadowbench::gate
