#include "cli/command.h"
#include "history/history_report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct AddOptions {
    std::filesystem::path records, to = "results/history";
    bool dirty = false;
};

struct ShowOptions {
    std::filesystem::path from = "results/history", out;
    history::Selection selection;
    std::string format = "text";
};

ExitCode add(const AddOptions& options) {
    const std::filesystem::path records =
        std::filesystem::is_directory(options.records) ? options.records / "results.jsonl" : options.records;
    const history::Added added = history::add(records, options.to, history::Repository::around(options.to), options.dirty);
    fmt::print("{}{}\n", added.file.string(), added.isNew ? "" : " holds these records already");
    return ExitCode::Pass;
}

ExitCode show(const ShowOptions& options) {
    const history::Findings findings = history::findingsOf(options.from, options.selection);
    fmt::print("{}", history::report(findings, options.format));
    if (options.out.empty()) return ExitCode::Pass;
    const auto files = history::writeReport(findings, options.out);
    if (options.format != "text") return ExitCode::Pass; // a machine reads what is printed
    fmt::print("page: {}\ncharts: {}\n", files.front().string(), files.size() - 1);
    return ExitCode::Pass;
}

} // namespace

void addHistory(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("history", "Keeps the records of past commits and shows where figures changed");
    verb->require_subcommand(1);
    verb->footer("Examples:\n  shadowbench history add results/latest\n  shadowbench history show --metric 'accuracy.*'");

    const auto added = std::make_shared<AddOptions>();
    CLI::App* addVerb = verb->add_subcommand("add", "Takes the records of a run of one commit into the history");
    addVerb->footer("Example:\n  shadowbench history add results/latest");
    addVerb->add_option("records", added->records, "Records: a file, or the folder of a run")->required();
    addVerb->add_option("--to", added->to, "Folder of the history, in a clone that has the commit")->capture_default_str();
    addVerb->add_flag("--dirty", added->dirty, "Take records that were measured with changes that are not committed");
    addVerb->callback([&action, added] { action = [added] { return add(*added); }; });

    const auto shown = std::make_shared<ShowOptions>();
    CLI::App* showVerb = verb->add_subcommand("show", "Shows every change over commits, the largest first; exit code 0");
    showVerb->footer("Example:\n  shadowbench history show --technique 'sm-*' --scene dueling-frusta --out changes");
    showVerb->add_option("--from", shown->from, "Folder of the history")->capture_default_str();
    showVerb->add_option("--metric", shown->selection.metrics,
                         "Path in the record, with * and ?; repeatable (default: all)");
    showVerb->add_option("--scene", shown->selection.scenes, "Scene id, with * and ?; repeatable (default: all)");
    showVerb->add_option("--technique", shown->selection.techniques,
                         "Technique id or variant, with * and ?; repeatable (default: all)");
    showVerb->add_option("--out", shown->out, "Write report.md there, with a chart for each metric and scene");
    showVerb->add_option("--format", shown->format, "What is printed: text, md or json")
        ->check(CLI::IsMember({"text", "md", "json"}))
        ->capture_default_str();
    showVerb->callback([&action, shown] { action = [shown] { return show(*shown); }; });
}

} // namespace shadowbench
