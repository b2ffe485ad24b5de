// One side of `shadowbench ci`: what the renderers of a commit draw.
#pragma once

#include "gate/ci.h"
#include "gate/worktree.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct CiSide {
    CiConfig config;
    std::vector<Record> records;
    std::filesystem::path images, logs; // folders, which may be missing; logs as `run` keeps them, and build.txt
    std::string failure;                // why there are no records, as a sentence; "" where there are
};

/// Where sides are kept: `<cache>/ci/<repository>`, with a folder for each tree of files, configuration and program.
class CiSides {
public:
    CiSides(const ForeignRepository& repository, const CiOptions& options, std::filesystem::path cache);

    /// Of `commit`, as it was kept, or from a work tree: its build, then a call of each renderer on each scene that is not
    /// kept. Throws BadInput for what its configuration says wrongly.
    [[nodiscard]] CiSide of(const JudgedCommit& commit) const;

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

private:
    void measure(const JudgedCommit& commit, const std::filesystem::path& kept) const;
    [[nodiscard]] std::string whyNotBuilt(const CiConfig& config, const std::filesystem::path& tree,
                                          const std::filesystem::path& log) const;
    void prune() const;

    const ForeignRepository& repository_;
    const CiOptions& options_;
    std::filesystem::path cache_, file_, folder_; // `file_`: the configuration, from the root
};

} // namespace shadowbench::gate
