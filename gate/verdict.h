// The verdict on a comparison, as an exit code and as reports for people, CI and JUnit.
#pragma once

#include "base/error.h"
#include "harness/records/compare.h"

#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::gate {

/// Inconclusive if anything is NotCompared, else AccuracyRegression if anything but cost is Worse, CostRegression if only
/// cost is, else Pass.
ExitCode verdictOf(const std::vector<Change>& changes);

/// "cost regression", for a verdict.
std::string_view verdictText(ExitCode code);
std::string_view name(Direction direction);

/// How far the change exceeds what means nothing; what was lost exceeds everything.
double excess(const Change& change);

/// All that is not the same: Worse, NotCompared, Unclear, Waived, Better, each by its excess.
std::vector<Change> worstFirst(const std::vector<Change>& changes);

/// One change a result, class and direction, the worst of them; how many more there are stands at the end of its sentence.
std::vector<Change> oneACause(const std::vector<Change>& worstFirst);

/// A line for each change that is not the same, the worst first, then how many there are and what was compared.
std::string changesReport(const Comparison& comparison);

/// JUnit XML: a test suite a scene, a test case a technique and class. What is Worse is a failure, what is NotCompared an
/// error, what is Unclear or Waived is skipped; their texts are the changes' sentences. What a time would have shown is the
/// case's output. `notCompared`, sentences on no cell, are errors of a suite "gate".
std::string junit(const std::vector<Change>& changes, const std::vector<std::string>& notCompared = {});

/// One `::error` line for each result and cause that is Worse and one `::warning` for what could not be told, which CI hosts
/// show beside the commit; one for each of `notCompared`, sentences on no cell. Of their text nothing is taken for a
/// command.
std::string annotations(const std::vector<Change>& changes, const std::vector<std::string>& notCompared = {});

} // namespace shadowbench::gate
