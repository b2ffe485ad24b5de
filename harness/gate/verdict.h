// The verdict on a comparison, as an exit code and as reports for people, CI and JUnit.
#pragma once

#include "base/error.h"
#include "harness/records/compare.h"

#include <string>
#include <vector>

namespace shadowbench::gate {

/// AccuracyRegression if anything but cost is Worse, CostRegression if only cost is, else Pass.
ExitCode verdictOf(const std::vector<Change>& changes);

/// "text" for a terminal or "md": what is worse, what is better, and how much is the same.
std::string changesReport(const std::vector<Change>& changes, const std::string& format);

/// JUnit XML: a test suite a scene, a test case a technique and class; a failure's text is its sentences.
std::string junit(const std::vector<Change>& changes);

/// One `::error` line for each Worse change, which CI hosts show beside the commit.
std::string annotations(const std::vector<Change>& changes);

} // namespace shadowbench::gate
