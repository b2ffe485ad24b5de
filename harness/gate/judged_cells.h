// Which cells a gate judges, as the steps that a program is asked for.
#pragma once

#include "harness/gate/gate.h"
#include "harness/gate/paired_run.h"
#include "harness/gate/watchlist.h"

#include <string>
#include <vector>

namespace shadowbench::gate {

struct PlannedScene {
    std::string id, argument;          // what `--scene` is given: the id, or an absolute path
    std::string content;               // of the file; empty for a built-in scene
    std::vector<std::string> variants; // that are judged there, by their canonical names
};

struct Plan {
    Watchlist watchlist;
    std::vector<PlannedScene> scenes;
    Profile profile = Profile::Gate;
    std::uint32_t seed = 1;

    /// Of what `options` choose. Throws BadInput.
    explicit Plan(const GateOptions& options);

    /// What a program that has all scenes and variants, or `program`, runs. With `instructions`, those that the watchlist
    /// names are counted, or all when it names none of the scenes.
    [[nodiscard]] std::vector<Step> steps(const Program& program, bool instructions) const;

    /// As the watchlist names them, or all when it names none of the scenes.
    [[nodiscard]] std::vector<TimedCell> timedCells(const Program& base, const Program& head) const;

    [[nodiscard]] bool chooses(const std::string& scene, const std::string& variant) const;
};

} // namespace shadowbench::gate
