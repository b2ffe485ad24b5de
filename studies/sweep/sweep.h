// One quantity moved over a range: error curves of techniques and the points at which they break
// (docs/metrics.md, "Break points").
#pragma once

#include "base/error.h"
#include "harness/cells/cell.h"
#include "harness/records/record.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench {

struct SweepOptions {
    std::string scene; // id or file
    std::string axis;
    std::vector<double> values;          // in order; empty: the axis' own
    std::vector<std::string> techniques; // variants or globs; empty: all that the axis concerns
    Profile profile = Profile::Gate;
    std::filesystem::path cache;
    std::uint32_t seed = 1;
    CellWork work = CellWork::Counted;
    bool quiet = false;
};

struct SweepResult {
    std::vector<Record> records; // curve by curve, in the order of the values
    ExitCode code = ExitCode::Pass;
};

/// Scores the last still frame of every technique at every value; lights and casters stand still, nothing is timed. A value
/// at which the scene has no sound set-up (the light inside a mesh) or a technique does not apply gives a record that says
/// so. Values are scored in as many processes as the machine runs at once: must be called without a GL context. Throws
/// BadInput for an unknown scene, axis or technique, and for an axis that the scene or all techniques lack.
SweepResult sweep(const SweepOptions& options);

/// The first value of a curve, in order, at which the scene's tolerance is exceeded; nothing if it never is, or the scene
/// states none.
std::optional<double> breakPoint(const std::vector<Record>& curve);

} // namespace shadowbench
