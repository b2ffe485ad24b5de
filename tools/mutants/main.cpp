// mutants: plants each fault in a copy of the tree, runs the program with and without it, and reports what comparing their
// records tells.
#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/environment.h"
#include "tools/mutants/outcome.h"
#include "tools/mutants/tool.h"
#include "tools/mutants/tree_copy.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>

namespace shadowbench::mutants {
namespace {

struct Options {
    std::vector<std::string> only;
    std::filesystem::path folder = std::filesystem::path(SOURCE_FOLDER) / "build/mutants";
    std::filesystem::path report = std::filesystem::path(SOURCE_FOLDER) / "results/gate/mutants.md";
    bool list = false;
};

std::string hashOf(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += word + '\0';
    return fmt::format("{:016x}", hash64(all));
}

/// Records, made once and kept: one file for what one program is asked once.
class Suite {
public:
    Suite(std::vector<Mutant> mutants, const std::filesystem::path& folder)
        : mutants_(std::move(mutants)), folder_(std::filesystem::absolute(folder)), tree_(SOURCE_FOLDER, folder_ / "tree"),
          records_(folder_ / "records" / tree_.hash()) {
        for (const Mutant& mutant : mutants_) planted(mutant, tree_.read(mutant.file)); // all fit, before the long part
    }

    std::vector<Outcome> runAll() {
        makeBases();
        std::vector<Outcome> outcomes;
        for (const Mutant& mutant : mutants_) {
            fmt::print("{:3}/{} {:<32} ", outcomes.size() + 1, mutants_.size(), mutant.id);
            std::fflush(stdout);
            makeMutated(mutant);
            outcomes.push_back(outcomeOf(mutant, readRecords(baseFile(mutant)), readRecords(mutatedFile(mutant))));
            printOutcome(outcomes.back());
        }
        return outcomes;
    }

private:
    [[nodiscard]] std::filesystem::path baseFile(const Mutant& mutant) const {
        return records_ / fmt::format("base-{}.jsonl", hashOf(arguments(mutant)));
    }

    [[nodiscard]] std::filesystem::path mutatedFile(const Mutant& mutant) const {
        std::vector<std::string> words = arguments(mutant);
        words.insert(words.end(), {mutant.file.string(), mutant.find, mutant.replace});
        return records_ / fmt::format("{}-{}.jsonl", mutant.id, hashOf(words));
    }

    void makeBases() {
        std::map<std::filesystem::path, const Mutant*> missing;
        for (const Mutant& mutant : mutants_)
            if (!std::filesystem::exists(baseFile(mutant))) missing[baseFile(mutant)] = &mutant;
        if (missing.empty()) return;
        fmt::print("building without a fault\n");
        std::fflush(stdout);
        tree_.build();
        for (const auto& [file, mutant] : missing) {
            fmt::print("base: {}\n", fmt::join(arguments(*mutant), " "));
            std::fflush(stdout);
            record(*mutant, file);
        }
    }

    void makeMutated(const Mutant& mutant) {
        if (std::filesystem::exists(mutatedFile(mutant))) return;
        try {
            const PlantedFault fault(tree_, mutant.file, planted(mutant, tree_.read(mutant.file)));
            tree_.build();
            record(mutant, mutatedFile(mutant));
        } catch (const InternalError& error) {
            throw InternalError(fmt::format("mutant {}: {}", mutant.id, error.what()));
        }
    }

    /// Runs the program that has been built and keeps its records, all or none.
    void record(const Mutant& mutant, const std::filesystem::path& file) const {
        const std::filesystem::path out = folder_ / "running";
        std::filesystem::remove_all(out);
        std::vector<std::string> words = arguments(mutant);
        words.insert(words.end(), {"--out", out.string(), "--cache", groundtruth::defaultCacheFolder().string()});
        runTool(tree_.program(), words, folder_);
        writeRecords(file, readRecords(out / (mutant.sweep ? "sweep.jsonl" : "results.jsonl")));
    }

    static void printOutcome(const Outcome& outcome) {
        const auto seen = strongest(outcome);
        fmt::print("{:<9} {}\n",
                   outcome.caughtInClass() ? "caught"
                   : outcome.caught()      ? "elsewhere"
                                           : "SURVIVES",
                   seen ? fmt::format("{}: {}", name(seen->changeClass), seen->sentence) : "");
        std::fflush(stdout);
    }

    std::vector<Mutant> mutants_;
    std::filesystem::path folder_;
    TreeCopy tree_;
    std::filesystem::path records_;
};

void print(const std::vector<Mutant>& mutants) {
    for (const Mutant& mutant : mutants)
        fmt::print("{:<32} {:<13} {:<22} {}\n", mutant.id, name(mutant.expected),
                   fmt::format("{}", fmt::join(mutant.techniques, " ")), mutant.what);
}

/// A survivor with a reason is known; one without is a hole in the gate.
ExitCode verdict(const std::vector<Outcome>& outcomes) {
    for (const Outcome& outcome : outcomes)
        if (!outcome.caughtInClass() && outcome.mutant.survives.empty()) return ExitCode::AccuracyRegression;
    return ExitCode::Pass;
}

ExitCode run(const Options& options) {
    const std::filesystem::path source = SOURCE_FOLDER;
    const std::vector<Mutant> all =
        onTheGatesScenes(readMutants(source / "tools/mutants/mutants.toml"),
                         gate::readWatchlist(source / "harness/gate/bounds.toml", Profile::Gate));
    const std::vector<Mutant> chosen = matching(all, options.only);
    if (options.list) {
        print(chosen);
        return ExitCode::Pass;
    }
    const std::vector<Outcome> outcomes = Suite(chosen, options.folder).runAll();
    if (chosen.size() == all.size()) {
        const Commit commit = builtFrom();
        writeFile(options.report, mutantsReport(outcomes, fmt::format("commit {}{}", commit.hash.substr(0, 12),
                                                                      commit.dirty ? ", changed" : "")));
        fmt::print("report: {}\n", options.report.string());
    }
    return verdict(outcomes);
}

} // namespace
} // namespace shadowbench::mutants

int main(int argc, char** argv) {
    shadowbench::mutants::Options options;
    CLI::App app(
        "Plants faults in a copy of the tree and reports which of them comparing records tells. Goes on where it was "
        "stopped. Exits with 4 when a fault survives that is not known to.",
        "mutants");
    app.add_option("--only", options.only, "Glob over ids; repeatable (default: all, and the report is written)");
    app.add_flag("--list", options.list, "Print the mutants and do nothing");
    app.add_option("--folder", options.folder, "Folder of the copy, its build and the records")->capture_default_str();
    app.add_option("--report", options.report, "Where the report on all mutants goes")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        return static_cast<int>(shadowbench::mutants::run(options));
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "mutants: {}\n", error.what());
        return static_cast<int>(error.code());
    }
}
