#include "base/files.h"
#include "cli/command.h"
#include "cli/options.h"
#include "gate/gate_report.h"
#include "gate/verdict.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct CompareOptions {
    std::filesystem::path base, head, junit, summary;
    bool annotations = false;
    bool sameProgram = false; // one program on both sides is meant
};

ExitCode compareAndPrint(const CompareOptions& options) {
    const std::vector<Record> base = recordsAt(options.base), head = recordsAt(options.head);
    const gate::GateResult compared = gate::comparedRecords(base, head, options.sameProgram);
    if (!compared.notCompared.empty()) throw Inconclusive(compared.notCompared.front());
    fmt::print("{}", gate::changesReport(compared));
    if (!options.sameProgram && gate::sameProgram(base, head)) fmt::print("both commits make the same program\n");
    if (options.annotations) fmt::print("{}", gate::annotations(compared.changes));
    if (!options.junit.empty()) writeFile(options.junit, gate::junit(compared.changes));
    if (!options.summary.empty()) writeFile(options.summary, gate::gateComment(compared, {}));
    return compared.code();
}

} // namespace

void addCompare(CLI::App& app, Action& action) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* verb = app.add_subcommand("compare", "Compares two sets of records: what changed, with a verdict");
    verb->footer(
        "Example:\n  shadowbench compare results/published results/latest --summary changes.md\n"
        "Exits with 5 when something could not be compared, such as a result that one side lacks or that failed, or when "
        "both are\nof one program; else with 4 when accuracy or stability is worse, and with 3 when only cost is.");
    verb->add_option("base", options->base, "Records to compare with: a file, or the folder of a run")->required();
    verb->add_option("head", options->head, "Records to judge")->required();
    verb->add_option("--junit", options->junit, "Write the verdicts as JUnit XML");
    verb->add_option("--summary", options->summary,
                     "Write the verdict and the worst there, in 40 lines of Markdown at most");
    verb->add_flag("--annotations", options->annotations, "Print what is worse as CI annotations too");
    verb->add_flag("--same-program", options->sameProgram, "Both are records of one program, on purpose");
    verb->callback([&action, options] { action = [options] { return compareAndPrint(*options); }; });
}

} // namespace shadowbench
