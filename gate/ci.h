// `shadowbench ci`: renderers of a repository that is not ours, as one of its commits builds them, against those of another
// (docs/ci.md). It makes two sets of records with `run`; the comparison, the rules and the reports are the gate's.
#pragma once

#include "gate/ci_config.h"
#include "gate/gate.h"

#include <filesystem>
#include <string>

namespace shadowbench::gate {

struct CiOptions {
    std::string base;                         // a revision; "": see ForeignRepository::base
    std::filesystem::path config;             // empty: shadowbench.toml at the repository's root
    std::filesystem::path out = "results/ci"; // of the report, pictures and logs
    std::filesystem::path cache;              // empty: the default
    bool quiet = false;
};

struct CiResult {
    GateResult result;
    GateOptions shown;          // what the gate's reports name: base, scenes, files of renderers, out
    std::filesystem::path root; // of the repository, which those files begin at
};

/// Judges the repository that holds the working directory. What was measured of a tree of files is kept in the cache and not
/// measured again. Throws BadInput for what the head's configuration says wrongly, Inconclusive without a base.
CiResult judgeCommits(const CiOptions& options);

} // namespace shadowbench::gate
