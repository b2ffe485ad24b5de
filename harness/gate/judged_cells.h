// Which cells a gate judges, and the runs of a program that measure them.
#pragma once

#include "harness/gate/gate.h"
#include "harness/gate/paired_run.h"
#include "harness/gate/watchlist.h"

#include <string>
#include <vector>

namespace shadowbench::gate {

struct JudgedScene {
    std::string id;
    std::string argument;              // of `--scene`: the id, or an absolute path
    std::string content;               // of the file; empty for a built-in scene
    std::vector<std::string> variants; // that are judged there, by their canonical names
};

struct JudgedCells {
    Watchlist watchlist;
    std::vector<JudgedScene> scenes;
    Profile profile = Profile::Gate;
    std::uint32_t seed = 1;

    /// The cells that `options` choose. Throws BadInput for an unknown scene or technique, Inconclusive without a file of
    /// bounds.
    explicit JudgedCells(const GateOptions& options);

    /// The runs that measure all cells whose scene and variant `program` has. With `instructions`, the instructions of those
    /// that the watchlist names are counted, or of all when it names none of the scenes.
    [[nodiscard]] std::vector<Step> steps(const MeasuredProgram& program, bool instructions) const;

    /// Cells that both programs have and whose time is compared: those that the watchlist names, or all when it names none
    /// of the scenes.
    [[nodiscard]] std::vector<TimedCell> timedCells(const MeasuredProgram& base, const MeasuredProgram& head) const;

    [[nodiscard]] bool chooses(const std::string& scene, const std::string& variant) const;
};

} // namespace shadowbench::gate
