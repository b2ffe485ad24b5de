// The verdict on a comparison, as an exit code and as reports for people, CI and JUnit.
#pragma once

#include "base/error.h"
#include "harness/records/compare.h"

#include <string>
#include <vector>

namespace shadowbench::gate {

/// AccuracyRegression if anything but cost is Worse, CostRegression if only cost is; without either, Inconclusive if
/// anything is Unjudged, else Pass.
ExitCode verdictOf(const std::vector<Change>& changes);

/// "text" for a terminal or "md": what is worse, not judged, unclear or better, and how much is the same.
std::string changesReport(const std::vector<Change>& changes, const std::string& format);

/// JUnit XML: a test suite a scene, a test case a technique and class. What is Worse is a failure, what is Unjudged an
/// error, what is Unclear is skipped; their texts are the changes' sentences. `unjudged`, sentences on no cell, are errors
/// of a suite "gate".
std::string junit(const std::vector<Change>& changes, const std::vector<std::string>& unjudged = {});

/// One `::error` line for each Worse change and one `::warning` for what could not be told, which CI hosts show beside the
/// commit.
std::string annotations(const std::vector<Change>& changes);

} // namespace shadowbench::gate
