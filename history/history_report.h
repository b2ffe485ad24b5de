// Reports of what changed over commits.
#pragma once

#include "history/changes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::history {

/// All that the reports are made from.
struct Findings : Levels {
    History history;
    std::vector<std::string> subjects;   // of the history's commits; "" where no repository knows
    std::vector<std::string> unreadable; // sentences about files that were left out
    std::vector<Event> events;
    std::vector<LevelChange> changes;
    std::vector<Suspects> suspects;
};

/// What the history in `folder` shows of `selection`. Throws BadInput where the
/// folder holds nothing of it.
Findings findingsOf(const std::filesystem::path& folder, const Selection& selection);

/// How many commits and series there are, and what happened to them.
std::string summaryOf(const Findings& findings);

/// The unit that figures of a metric are written in: shares in per cent, instructions in millions.
struct Unit {
    double factor = 1;
    std::string name; // " %"
};
Unit unitOf(const std::string& metric);

/// A figure with its unit.
std::string formatFigure(const std::string& metric, double value);

/// The first digits of a commit.
std::string shortHash(const std::string& commit);

/// The command that measures the cells of a set of suspects at the commit that halves them, and adds them to the history.
std::string narrowingCommand(const Findings& findings, const Suspects& suspects);

/// "text" for a terminal, "md" or "json". The Markdown names a chart `chartName` for each scene and metric where `charts`.
std::string report(const Findings& findings, const std::string& format, bool charts = false);

/// "<metric>-<scene>.svg".
std::string chartName(const std::string& metric, const std::string& scene);

/// The figures of a metric on a scene over commits as SVG: techniques that change in colour, others in grey.
std::string chart(const Findings& findings, const std::string& metric, const std::string& scene);

/// Scenes and metrics that have a series over several commits, in the order of the history's series; whether cells are in
/// error only where that changes.
std::vector<std::pair<std::string, std::string>> chartedMetrics(const Findings& findings); // scene, metric

/// Writes `folder`/report.md and its charts.
std::vector<std::filesystem::path> writeReport(const Findings& findings, const std::filesystem::path& folder);

} // namespace shadowbench::history
