#include "base/error.h"
#include "base/temporary_folder.h"
#include "base/words.h"
#include "cli/command.h"
#include "cli/options.h"
#include "harness/records/comparability.h"
#include "history/history_report.h"
#include "site/site.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <set>
#include <string>

namespace shadowbench {
namespace {

struct ReportOptions {
    std::vector<std::filesystem::path> records{"results/latest/results.jsonl"};
    std::filesystem::path out;    // empty: the folder of the first records
    std::filesystem::path images; // empty: images/ beside the first records
    std::filesystem::path base, history, singleFile;
    std::string sequences = "fronts";
    std::vector<std::string> named;
    bool standing = false;
};

/// All records of the files, in order; a folder stands for its results.jsonl.
std::vector<Record> recordsOf(std::vector<std::filesystem::path> files) {
    for (std::filesystem::path& file : files)
        if (std::filesystem::is_directory(file)) file /= "results.jsonl";
    return gate::readOfOneDevice(files);
}

/// Each name is that of a variant or a technique of the records.
void requireNamed(const std::vector<std::string>& named, const std::vector<Record>& records) {
    std::set<std::string> known;
    for (const Record& record : records) known.insert({record.variant, record.technique});
    for (const std::string& name : named)
        if (!known.contains(name))
            throw BadInput(
                fmt::format("--label: no record is of a variant or technique \"{}\"{}; name one that the table has", name,
                            didYouMean(name, {known.begin(), known.end()})));
}

std::filesystem::path folderOf(const std::filesystem::path& records) {
    return std::filesystem::is_directory(records) ? records : records.parent_path();
}

site::Sources sourcesOf(const ReportOptions& options, const std::filesystem::path& folder) {
    site::Sources sources{.records = recordsOf(options.records),
                          .images = options.images.empty() ? folder / "images" : options.images,
                          .sequences = options.sequences == "all" ? site::Sequences::All : site::Sequences::Fronts,
                          .named = options.named,
                          .standing = options.standing};
    requireNamed(options.named, sources.records);
    if (!options.base.empty()) {
        sources.base = recordsOf({options.base});
        sources.baseName = options.base.string();
        sources.baseImages = folderOf(options.base) / "images";
    }
    if (!options.history.empty()) sources.findings = history::findingsOf(options.history, {});
    return sources;
}

ExitCode makeReport(const ReportOptions& options) {
    const std::filesystem::path& first = options.records.front();
    const std::filesystem::path folder = folderOf(first);
    const site::Sources sources = sourcesOf(options, folder);
    if (!options.singleFile.empty()) {
        const TemporaryFolder parts;
        site::writeSite(sources, parts.path());
        site::writeSingleFile(parts.path(), options.singleFile);
        fmt::print("page: {}\n", options.singleFile.string());
        return ExitCode::Pass;
    }
    const std::filesystem::path out = options.out.empty() ? folder : options.out;
    const std::filesystem::path data = out / "results.jsonl";
    std::error_code ignored;
    if (!options.out.empty() && !std::filesystem::equivalent(first, data, ignored)) writeRecords(data, sources.records);
    fmt::print("page: {}\n", site::writeSite(sources, out).string());
    return ExitCode::Pass;
}

} // namespace

void addReport(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ReportOptions>();
    CLI::App* verb = app.add_subcommand("report", "Renders records as pages, tables and charts");
    verb->footer(
        "Examples:\n  shadowbench report results/latest/results.jsonl\n"
        "  shadowbench report results/published/results.jsonl results/sweeps/*/sweep.jsonl --history results/history "
        "--out public\n"
        "  shadowbench report results/latest/results.jsonl --base before.jsonl --single-file run.html\n"
        "  shadowbench report results/latest/results.jsonl --sequences all --out /tmp/site");
    verb->add_option("records", options->records,
                     "Record files of run and sweep; a folder of a run stands for its results.jsonl")
        ->capture_default_str();
    CLI::Option* out = verb->add_option("--out", options->out, "Folder to write into (default: that of the first records)");
    verb->add_option("--images", options->images,
                     "Folder of pictures by `run --images` (default: images beside the first records)");
    verb->add_option("--base", options->base, "Older records: a page says what is worse than there");
    verb->add_option("--history", options->history, "Folder of a history: a page shows figures over commits");
    verb->add_option("--sequences", options->sequences,
                     "Whose moving frames are shown: fronts (the rows of each scene's Pareto front) or all")
        ->check(CLI::IsMember({"fronts", "all"}))
        ->capture_default_str();
    verb->add_option("--label", options->named,
                     "Variant or technique that charts of error against cost label beside the Pareto front; repeatable");
    addStaticOption(*verb, options->standing);
    verb->add_option("--single-file", options->singleFile, "Write everything into this one file instead")->excludes(out);
    verb->callback([&action, options] { action = [options] { return makeReport(*options); }; });
}

} // namespace shadowbench
