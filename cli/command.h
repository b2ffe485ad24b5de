// The verbs of the command line: each file adds one, with its options, its help and what it does.
#pragma once

#include "base/error.h"

#include <functional>

namespace CLI {
class App;
}

namespace shadowbench {

/// What the command line asks for: set while it is parsed, run afterwards. Errors are exceptions (base/error.h).
using Action = std::function<ExitCode()>;

/// Each adds its verb to `app`; a command line that names the verb sets `action`, which must outlive the parsing.
void addList(CLI::App& app, Action& action);
void addInspect(CLI::App& app, Action& action);
void addRun(CLI::App& app, Action& action);
void addMerge(CLI::App& app, Action& action);
void addScore(CLI::App& app, Action& action);
void addReference(CLI::App& app, Action& action);
void addSweep(CLI::App& app, Action& action);
void addCauses(CLI::App& app, Action& action);
void addDevelop(CLI::App& app, Action& action);
void addCheck(CLI::App& app, Action& action);
void addNewTechnique(CLI::App& app, Action& action);
void addRecommend(CLI::App& app, Action& action);
void addClaims(CLI::App& app, Action& action);
void addPapers(CLI::App& app, Action& action);
void addShaderCost(CLI::App& app, Action& action);
void addGpuCost(CLI::App& app, Action& action);
void addExport(CLI::App& app, Action& action);
void addCache(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addHistory(CLI::App& app, Action& action);
void addGate(CLI::App& app, Action& action);
void addCi(CLI::App& app, Action& action);
void addReport(CLI::App& app, Action& action);
void addFigure(CLI::App& app, Action& action);
void addCountFrames(CLI::App& app, Action& action);
void addTimeFrames(CLI::App& app, Action& action);

} // namespace shadowbench
