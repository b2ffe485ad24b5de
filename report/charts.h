// The charts of a scene, as SVG.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::report {

/// Headline error against cost, both logarithmic, with the Pareto front and the tolerance; nothing if no record was timed.
/// The front is labelled, and the variants and techniques that are `named`; the others are dots in their family's colour.
std::optional<std::string> paretoChart(const std::vector<Record>& records, const std::string& scene,
                                       const std::vector<std::string>& named = {});

/// The same against the milliseconds that a frame is modelled to take on a card, `on` (report/costing.h); nothing if no
/// record has such.
std::optional<std::string> modelledChart(const std::vector<Record>& records, const std::string& scene, const std::string& on,
                                         const std::vector<std::string>& named = {});

/// Error over the still frames from an empty history: against the truth, and against the technique's own last image; nothing
/// without curves.
std::optional<std::string> convergenceChart(const std::vector<Record>& records, const std::string& scene);

/// A technique's error by frame; one number alone is a level over all frames.
struct FramesCurve {
    std::string name;
    std::vector<double> values;
};

/// Errors over the frames, both logarithmic; nothing without curves. `error` is what the upright axis shows.
std::optional<std::string> framesChart(const std::string& title, const std::string& error,
                                       const std::vector<FramesCurve>& curves);

/// Error of every technique over the quantity that a sweep moved, in the scene's tolerance metric (its headline metric if it
/// states none), with the tolerance as a line. `records` are those of one sweep; nothing if none was scored. `logarithmic`:
/// the quantity's axis is.
std::optional<std::string> sweepChart(const std::vector<Record>& records, bool logarithmic);

} // namespace shadowbench::report
