// mutants: plants each fault in a copy of the tree, runs the program or its tests with and without it, and reports what is
// detected.
#include "base/error.h"
#include "base/files.h"
#include "harness/cells/environment.h"
#include "tools/mutants/outcome.h"
#include "tools/mutants/tree_copy.h"
#include "tools/mutants/trial.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::mutants {
namespace {

struct Options {
    std::vector<std::string> only;
    std::string shard;
    std::filesystem::path folder = std::filesystem::path(SOURCE_FOLDER) / "build/mutants";
    std::filesystem::path report = std::filesystem::path(SOURCE_FOLDER) / "results/gate/mutants.md";
    bool list = false;
};

/// "2/3" → "tree-2-3": a shard builds in a copy of its own.
std::string treeName(const std::string& shard) {
    std::string name = shard.empty() ? "tree" : fmt::format("tree-{}", shard);
    std::ranges::replace(name, '/', '-');
    return name;
}

class Suite {
public:
    Suite(const std::vector<Mutant>& mutants, const std::filesystem::path& folder, const std::string& shard)
        : mutants_(mutants), tree_(SOURCE_FOLDER, folder / treeName(shard)), trials_(tree_, folder / "kept") {
        for (const Mutant& mutant : mutants_) planted(mutant, tree_.read(mutant.file)); // all fit, before the long part
    }

    /// Makes what is missing; one that cannot be built is said and left out. Returns how many those are.
    int make(const std::vector<Mutant>& chosen) {
        int failures = 0, number = 0;
        for (const Mutant& mutant : chosen) {
            fmt::print("{:3}/{} {:<36} ", ++number, chosen.size(), mutant.id);
            std::fflush(stdout);
            const auto start = std::chrono::steady_clock::now();
            try {
                if (!trials_.hasBase(mutant)) trials_.makeBase(mutant);
                if (!trials_.has(mutant)) trials_.make(mutant);
                printOutcome(outcome(mutant), std::chrono::steady_clock::now() - start);
            } catch (const InternalError& error) {
                ++failures;
                fmt::print("BROKEN    {}\n", error.what());
            }
        }
        return failures;
    }

    [[nodiscard]] bool isMade(const Mutant& mutant) const { return trials_.hasBase(mutant) && trials_.has(mutant); }

    [[nodiscard]] std::vector<Outcome> outcomes(const std::vector<Mutant>& mutants) const {
        std::vector<Outcome> result;
        for (const Mutant& mutant : mutants)
            if (isMade(mutant)) result.push_back(outcome(mutant));
        return result;
    }

private:
    [[nodiscard]] Outcome outcome(const Mutant& mutant) const {
        return outcomeOf(mutant, trials_.base(mutant), trials_.of(mutant));
    }

    static void printOutcome(const Outcome& outcome, std::chrono::duration<double> time) {
        const auto seen = strongest(outcome);
        fmt::print("{:5.0f} s  {}  {}\n", time.count(), verdict(outcome),
                   seen ? fmt::format("{}: {}", name(seen->changeClass), seen->sentence) : outcome.refused);
        std::fflush(stdout);
    }

    const std::vector<Mutant>& mutants_;
    TreeCopy tree_;
    Trials trials_;
};

void print(const std::vector<Mutant>& mutants) {
    for (const Mutant& mutant : mutants)
        fmt::print("{:<36} {:<34} {:<22} {}\n", mutant.id, expectedText(mutant),
                   fmt::format("{}", fmt::join(mutant.techniques, " ")), mutant.what);
}

/// A survivor or a false red with a reason is known; one without is a hole in the gate.
ExitCode exitCode(const std::vector<Outcome>& outcomes) {
    for (const Outcome& outcome : outcomes)
        if (!outcome.asExpected() && outcome.mutant.survives.empty()) return ExitCode::AccuracyRegression;
    return ExitCode::Pass;
}

void report(const std::vector<Outcome>& outcomes, const std::filesystem::path& file) {
    const Commit commit = builtFrom();
    writeFile(file, mutantsReport(outcomes,
                                  fmt::format("commit {}{}", commit.hash.substr(0, 12), commit.dirty ? ", changed" : "")));
    fmt::print("report: {}\n", file.string());
}

ExitCode run(const Options& options) {
    const std::filesystem::path source = SOURCE_FOLDER;
    const std::vector<Mutant> all = onTheGatesScenes(readMutants(source / "tools/mutants/mutants.toml"),
                                                     gate::readGateConfig(source / "gate/bounds.toml", Profile::Gate));
    std::vector<Mutant> chosen = matching(all, options.only);
    if (!options.shard.empty()) chosen = shardOf(chosen, options.shard);
    if (options.list) {
        print(chosen);
        return ExitCode::Pass;
    }
    Suite suite(all, std::filesystem::absolute(options.folder), options.shard);
    const int failures = suite.make(chosen);
    const std::vector<Outcome> outcomes = suite.outcomes(all);
    if (outcomes.size() == all.size())
        report(outcomes, options.report);
    else
        fmt::print("{} of {} are made; the report is written when all are\n", outcomes.size(), all.size());
    return failures > 0 ? ExitCode::Internal : exitCode(suite.outcomes(chosen));
}

} // namespace
} // namespace shadowbench::mutants

int main(int argc, char** argv) {
    shadowbench::mutants::Options options;
    CLI::App app(
        "Plants faults in a copy of the tree and reports which of them are detected. Goes on where it was stopped, and "
        "makes "
        "again only what depends on sources that have changed. Exits with 4 when a fault survives, or a benign change is "
        "red, that is not known to.",
        "mutants");
    app.add_option("--only", options.only, "Glob over ids; repeatable (default: all)");
    app.add_option("--shard", options.shard,
                   "Every COUNTth of them from the INDEXth on, as INDEX/COUNT, in a copy of its own; the shard that ends "
                   "last writes the report");
    app.add_flag("--list", options.list, "Print the mutants and do nothing");
    app.add_option("--folder", options.folder, "Folder of the copies, their builds and what is kept")->capture_default_str();
    app.add_option("--report", options.report, "Where the report goes once all mutants are made")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        return static_cast<int>(shadowbench::mutants::run(options));
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "mutants: {}\n", error.what());
        return static_cast<int>(error.code());
    }
}
