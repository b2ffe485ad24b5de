#include "harness/history/history_report.h"

#include "base/error.h"

#include <fmt/format.h>

namespace shadowbench::history {
namespace {

constexpr double falseAlarms = 0.05; // of the whole report, among the noisy series

} // namespace

Findings findingsOf(const std::filesystem::path& folder, const Selection& selection) {
    const auto repository = Repository::around(folder);
    Stored stored = readHistory(folder);
    sortByAncestry(stored.commits, repository);
    Findings findings;
    findings.unreadable = stored.unreadable;
    findings.history = historyOf(stored.commits, selection);
    if (findings.history.series.empty())
        throw BadInput(
            fmt::format("{} holds no records of what was asked for; `shadowbench history add` adds some", folder.string()));
    for (const Commit& commit : findings.history.commits)
        findings.subjects.push_back(repository ? repository->subject(commit.hash) : "");
    findings.levels = levelsOf(findings.history, falseAlarms);
    findings.changes = changesBetween(findings.history, findings.levels);
    findings.suspects = suspectsOf(findings.history, findings.changes, repository);
    return findings;
}

} // namespace shadowbench::history
