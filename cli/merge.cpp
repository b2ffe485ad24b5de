#include "harness/runs/merge.h"

#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/run_result.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct MergeOptions {
    std::vector<std::filesystem::path> folders;
    std::filesystem::path out; // empty: the folder, if there is one only
};

std::filesystem::path outputOf(const MergeOptions& options) {
    if (!options.out.empty()) return options.out;
    if (options.folders.size() > 1)
        throw BadInput("merge needs --out, the folder of records and report, for several folders");
    return options.folders.front();
}

ExitCode mergeAndReport(const MergeOptions& options) {
    const std::filesystem::path out = outputOf(options);
    const shards::Merged merged = shards::merge(options.folders);
    for (const std::string& missing : merged.missing) fmt::print(stderr, "missing: {}\n", missing);
    if (!merged.missing.empty())
        throw Inconclusive(fmt::format(
            "{} of the manifest's cells are missing, so nothing is merged; run their shards again", merged.missing.size()));
    const OutputLock alone(out);
    for (const std::filesystem::path& folder : options.folders) shards::copyImages(folder, out);
    writeRecords(out / "results.jsonl", merged.result.records);
    return reportResult(merged.result, out);
}

} // namespace

void addMerge(CLI::App& app, Action& action) {
    const auto options = std::make_shared<MergeOptions>();
    CLI::App* verb = app.add_subcommand("merge", "Joins the parts of a run (`run --shard`, `run --cell`) and judges it");
    verb->footer("Examples:\n  shadowbench merge results/large\n"
                 "  shadowbench merge first-machine second-machine --out results/large\n"
                 "Writes results.jsonl and report as `run` does, and exits as it does. Exits with 5 when cells are missing "
                 "(each is named), or were\nmeasured in different environments, by different commits or by programs of "
                 "different sources.");
    verb->add_option("folders", options->folders, "Folders of one run's parts: --out of `run --shard`")->required();
    verb->add_option("--out", options->out, "Folder of records and report (default: the folder, if there is one only)");
    verb->callback([&action, options] { action = [options] { return mergeAndReport(*options); }; });
}

} // namespace shadowbench
