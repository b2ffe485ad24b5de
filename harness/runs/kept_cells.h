// Where a run keeps the cells that it has finished, and finds those of an earlier one: in one file of records, or, of a
// part, in a file each.
#pragma once

#include "harness/runs/cell_file.h"
#include "harness/runs/run.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

class KeptCells {
public:
    KeptCells() = default;
    KeptCells(const KeptCells&) = delete;
    KeptCells& operator=(const KeptCells&) = delete;
    virtual ~KeptCells() = default;

    /// What is kept of cell `cell` of this program without an error; it may lack costs. `blank` has its scene, variant, cell
    /// id and environment. May be called in a worker process.
    [[nodiscard]] virtual std::optional<shards::MeasuredCell> find(std::size_t cell, const Record& blank) const = 0;

    /// Keeps the cell, on disk when this returns, instead of what was there of it. Throws InternalError where it cannot.
    virtual void keep(std::size_t cell, shards::MeasuredCell measured) = 0;
};

/// results.jsonl in `options.out`: the cells in order, then what an earlier run has left of others.
class RecordsFile : public KeptCells {
public:
    RecordsFile(const RunOptions& options, std::size_t cells);
    [[nodiscard]] std::optional<shards::MeasuredCell> find(std::size_t cell, const Record& blank) const override;
    void keep(std::size_t cell, shards::MeasuredCell measured) override;

private:
    std::filesystem::path file_;
    std::vector<Record> earlier_;
    std::vector<std::string> earlierLines_; // of the same, empty once they are made again
    std::vector<std::string> lines_;        // of each cell: each is written many times, with every cell that follows
};

/// A file for each cell of a part, which others may be measuring, too. An error that may not come again is not kept.
class CellFiles : public KeptCells {
public:
    CellFiles(const RunOptions& options, const std::vector<shards::ManifestCell>& manifest);
    [[nodiscard]] std::optional<shards::MeasuredCell> find(std::size_t cell, const Record& blank) const override;
    void keep(std::size_t cell, shards::MeasuredCell measured) override;

    /// Whether the cell is kept with all costs that are asked for.
    [[nodiscard]] bool isFinished(std::size_t cell) const;

private:
    [[nodiscard]] std::optional<shards::MeasuredCell> valid(std::size_t cell) const;

    std::filesystem::path folder_;
    const std::vector<shards::ManifestCell>& manifest_;
};

} // namespace shadowbench
