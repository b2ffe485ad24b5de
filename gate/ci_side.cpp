#include "gate/ci_side.h"

#include "base/files.h"
#include "base/hash.h"
#include "base/progress_line.h"
#include "harness/cells/environment.h"
#include "harness/foreign/renderers.h"
#include "harness/runs/run.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::hours longestCommitBuild{2};
constexpr std::uintmax_t mostSaid = 16 << 20; // bytes, of a build
constexpr std::size_t mostKept = 16;          // trees of files: those of the branches that people work on

/// The configuration, from the repository's root.
fs::path configIn(const ForeignRepository& repository, const fs::path& asked) {
    if (asked.empty()) return usualConfig;
    const fs::path file = fs::weakly_canonical(asked).lexically_relative(fs::canonical(repository.root()));
    if (file.empty() || *file.begin() == "..")
        throw BadInput(fmt::format("--config {} lies outside the repository {}; each commit is judged by its own",
                                   asked.string(), repository.root().string()));
    return file;
}

void copyFile(const fs::path& from, const fs::path& to) {
    fs::create_directories(to.parent_path());
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
}

/// As `run` would of a command line in that tree.
RunOptions runOf(const CiConfig& config, const JudgedCommit& commit, const fs::path& tree, const fs::path& kept) {
    std::vector<fs::path> renderers;
    for (const fs::path& file : config.renderers) renderers.push_back(tree / file);
    RunOptions run;
    for (const std::string& scene : config.scenes)
        run.scenes.push_back(fs::path(scene).has_extension() ? (tree / scene).string() : scene);
    run.techniques = config.techniques;
    run.profile = config.profile;
    run.out = kept;
    run.measure.external = foreign::renderersOf(renderers, {kept / "logs", commit.hash});
    run.measure.time = false;
    run.measure.images = kept / "images";
    run.measure.pictures = true;
    run.resume = true;
    return run;
}

} // namespace

CiSides::CiSides(const ForeignRepository& repository, const CiOptions& options, fs::path cache)
    : repository_(repository), options_(options), cache_(std::move(cache)), file_(configIn(repository, options.config)),
      folder_(cache_ / "ci" / hash128(repository.root().string()).text()) {}

std::string CiSides::whyNotBuilt(const CiConfig& config, const fs::path& tree, const fs::path& log) const {
    fs::remove(log);
    if (config.build.empty()) return "";
    ProgressLine line("ci: build", 1, options_.quiet);
    Command command = unboundedCommand("/bin/sh", {"-c", config.build}, tree);
    command.limit = longestCommitBuild;
    command.outputLimit = mostSaid;
    command.endsStrays = true;
    std::string said;
    const Finished end = runProcess(command, [&](std::string_view text) {
        line.show(0, 0, text);
        said += std::string(text) + "\n";
    });
    if (end.exitCode == 0 && end.signal == 0) return "";
    writeFileUnflushed(log, said);
    if (end.timedOut) return "its build did not end within two hours";
    if (end.flooded) return fmt::format("its build said more than {} MiB", mostSaid >> 20U);
    if (end.signal != 0) return fmt::format("its build was ended by signal {}", end.signal);
    return fmt::format("its build ended with exit code {}", end.exitCode);
}

void CiSides::measure(const JudgedCommit& commit, const fs::path& kept) const {
    const Worktree tree(repository_, commit, folder_ / "worktree"); // one place for all: compilers' caches go by it
    const CiConfig config = readCiConfig(tree.root(), file_);
    fs::remove_all(kept / "files");
    for (const fs::path& file : config.files()) copyFile(tree.root() / file, kept / "files" / file);
    const std::string failure = whyNotBuilt(config, tree.root(), kept / "logs" / "build.txt");
    fs::remove(kept / "failure");
    if (!failure.empty()) return writeFile(kept / "failure", failure);
    RunOptions options = runOf(config, commit, tree.root(), kept);
    options.cache = cache_;
    options.quiet = options_.quiet;
    if (run(options).code == ExitCode::Pass) // one with errors is tried again
        writeFile(kept / "done", hash128(readFile(kept / "results.jsonl")).text());
}

CiSide CiSides::of(const JudgedCommit& commit) const {
    const std::string key = fmt::format("{}\n{}\n{}", commit.tree, file_.string(), programHash());
    const fs::path kept = folder_ / hash128(key).text(), records = kept / "results.jsonl", done = kept / "done";
    const bool isKept = fs::exists(done) && fs::exists(records) && hash128(readFile(records)).text() == readFile(done);
    if (!isKept) {
        fs::remove(done);
        measure(commit, kept);
    }
    fs::last_write_time(kept, fs::file_time_type::clock::now());
    prune();
    CiSide side{.config = readCiConfig(kept / "files", file_),
                .records = {},
                .images = kept / "images",
                .logs = kept / "logs",
                .failure = fs::exists(kept / "failure") ? readFile(kept / "failure") : ""};
    if (side.failure.empty()) side.records = readRecords(records);
    for (Record& record : side.records)
        if (record.external) record.external->revision = commit.hash; // another commit may have the same files
    return side;
}

/// The least recently used go.
void CiSides::prune() const {
    std::vector<std::pair<fs::file_time_type, fs::path>> kept;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
        if (entry.path().filename() != "worktree") kept.emplace_back(entry.last_write_time(), entry.path());
    std::ranges::sort(kept, std::greater());
    for (std::size_t i = mostKept; i < kept.size(); ++i) fs::remove_all(kept[i].second);
}

} // namespace shadowbench::gate
