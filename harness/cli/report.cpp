#include "harness/report/run_report.h"

#include "harness/cli/command.h"
#include "harness/cli/written_report.h"
#include "harness/records/comparability.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace shadowbench {
namespace {

struct ReportOptions {
    std::filesystem::path records = "results/latest/results.jsonl";
    std::filesystem::path out; // empty: the folder of the records
};

ExitCode makeReport(const ReportOptions& options) {
    const std::filesystem::path out = options.out.empty() ? options.records.parent_path() : options.out;
    printFiles(report::writeReport(gate::readOfOneDevice({options.records}), out));
    return ExitCode::Pass;
}

} // namespace

void addReport(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ReportOptions>();
    CLI::App* verb = app.add_subcommand("report", "Renders records as tables, charts and a page");
    verb->footer("Example:\n  shadowbench report results/latest/results.jsonl --out results/published");
    verb->add_option("records", options->records, "results.jsonl")->capture_default_str();
    verb->add_option("--out", options->out, "Folder to write into (default: that of the records)");
    verb->callback([&action, options] { action = [options] { return makeReport(*options); }; });
}

} // namespace shadowbench
