#include "studies/papers/papers.h"

#include "cli/command.h"
#include "cli/written_report.h"
#include "harness/records/comparability.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace shadowbench {
namespace {

struct PapersOptions {
    std::vector<std::filesystem::path> records{"results/latest/results.jsonl"};
    std::filesystem::path out = "results/papers";
};

ExitCode makePapers(const PapersOptions& options) {
    const std::vector<Record> records = gate::readOfOneDevice(options.records);
    printFiles(writePapers(records, options.out));
    return ExitCode::Pass;
}

} // namespace

void addPapers(CLI::App& app, Action& action) {
    const auto options = std::make_shared<PapersOptions>();
    CLI::App* verb =
        app.add_subcommand("papers", "Renders the papers' own tables and figures with our numbers beside theirs");
    verb->footer("Example:\n  shadowbench papers results/published/results.jsonl results/papers/results.jsonl");
    verb->add_option("records", options->records, "Record files of run and sweep")->capture_default_str();
    verb->add_option("--out", options->out, "Folder to write into")->capture_default_str();
    verb->callback([&action, options] { action = [options] { return makePapers(*options); }; });
}

} // namespace shadowbench
