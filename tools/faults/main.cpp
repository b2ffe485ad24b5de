// faults: makes calls of the program fail, kills it, and runs it beside itself; reports what becomes of files and records.
#include "base/error.h"
#include "base/files.h"
#include "tools/faults/trials.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <random>

namespace shadowbench::faults {
namespace {

struct Options {
    std::filesystem::path program = PROGRAM, out;
    Texts verbs;
    std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    bool lasting = false;
    int kills = 200, processes = 10;
    unsigned seed = 1;
};

Trial shown(Trial trial) {
    fmt::print("{:<10} {:<24} {:>6} {:>4}  {}\n", trial.verb, trial.call, trial.number, trial.code, trial.said);
    for (const std::string& fault : trial.faults) fmt::print("    FAULT {} ({})\n", fault, trial.what);
    std::fflush(stdout);
    return trial;
}

std::vector<Trial> failCalls(Sandbox& sandbox, const std::vector<Verb>& verbs, const Options& options) {
    std::vector<Trial> trials;
    for (const Verb& verb : verbs) {
        const Counts counts = sandbox.disturbed(verb, {}).counts;
        for (std::size_t p = 0; p < counts.size() - 1; ++p) { // the last are allocations
            const std::uint64_t count = counts.at(p);
            for (const std::uint64_t number : spread(count, options.most))
                trials.push_back(shown(disturb(sandbox, verb, {static_cast<Point>(p), number}, count)));
            if (options.lasting && count > 0)
                trials.push_back(shown(disturb(sandbox, verb, {static_cast<Point>(p), 1 + count / 2, true}, count)));
        }
        for (std::uint64_t number = 1;; number *= 2) {
            Trial trial = disturb(sandbox, verb, {Point::Allocation, number}, 0);
            if (!trial.reached) break;
            trials.push_back(shown(std::move(trial)));
        }
    }
    return trials;
}

std::vector<Trial> killVerbs(Sandbox& sandbox, const std::vector<Verb>& verbs, const Options& options) {
    std::vector<std::uint64_t> moments;
    for (const Verb& verb : verbs) moments.push_back(sandbox.disturbed(verb, {}).passed.size());
    std::mt19937 random(options.seed); // the same of one seed everywhere
    std::vector<Trial> trials;
    for (int i = 0; i < options.kills; ++i) {
        const std::size_t v = static_cast<std::size_t>(i) % verbs.size(); // each as often
        constexpr std::array signals{SIGKILL, SIGKILL, SIGTERM, SIGINT};
        Wanted wanted{.signal = signals.at(random() % signals.size())};
        wanted.toFirst = random() % 2 == 0;
        wanted.number = 1 + random() % moments[v];
        trials.push_back(shown(disturb(sandbox, verbs[v], wanted, moments[v])));
    }
    return trials;
}

/// Does what `word` says; the report, and whether anything is faulty.
std::pair<std::string, bool> report(const std::string& word, const Options& options, const std::string& command) {
    if (word == "together") {
        const Findings findings = workTogether(options.program, options.processes);
        return {togetherReport(findings, command), !findings.faults.empty()};
    }
    const std::vector<Verb> verbs = verbsNamed(options.verbs);
    Sandbox sandbox(options.program, verbs);
    if (word == "order") {
        Findings findings;
        for (const Verb& verb : verbs) checkOrder(sandbox, verb, findings);
        return {orderReport(findings, command), !findings.faults.empty()};
    }
    const bool kills = word == "kills";
    const std::vector<Trial> trials = (kills ? killVerbs : failCalls)(sandbox, verbs, options);
    return {(kills ? killsReport : callsReport)(trials, command),
            std::ranges::any_of(trials, [](const Trial& t) { return !t.faults.empty(); })};
}

int run(int argc, char** argv) {
    CLI::App app(
        "faults makes calls of shadowbench fail, kills it, and runs it beside itself, on scenes of a few pixels; it "
        "ends with 4 where files or records are harmed.");
    app.require_subcommand(1);
    Options options;
    app.add_option("--program", options.program, "What is tried")->capture_default_str();
    app.add_option("--out", options.out, "File for the report, in Markdown (default: the terminal)");
    CLI::App* calls =
        app.add_subcommand("calls", "Lets each call fail, one at a time: opens, writes, renames, fsyncs, forks, "
                                    "threads, pipes, and the 1st, 2nd, 4th … allocation");
    CLI::App* kills = app.add_subcommand("kills", "Kills verbs and their processes at calls that are drawn by chance");
    CLI::App* order =
        app.add_subcommand("order", "Sees that files are flushed before they are renamed, and folders after it");
    CLI::App* together = app.add_subcommand(
        "together", "Runs, gates, scores, merges, reports and prunes at once on one cache and one output");
    for (CLI::App* word : {calls, kills, order})
        word->add_option("--verb", options.verbs, "Comma-separated (default: all that write)")->delimiter(',');
    calls->add_option("--most", options.most, "Of each kind at most so many, evenly (default: all)");
    calls->add_flag("--lasting", options.lasting, "From the middle one on all of a kind, too: a disk that stays full");
    kills->add_option("number", options.kills, "How many")->capture_default_str();
    kills->add_option("--seed", options.seed, "Of the random numbers")->capture_default_str();
    together->add_option("number", options.processes, "Of each at once")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    std::signal(SIGINT, SIG_DFL); // a shell lets what it starts in the background ignore it, and so would the verbs

    const std::string word = app.get_subcommands().front()->get_name();
    const std::string command = fmt::format("build/release/tools/faults/faults {}", // as it stands in the report
                                            fmt::join(std::find(argv, argv + argc, word), argv + argc, " "));
    const auto [text, faulty] = report(word, options, command);
    if (options.out.empty())
        fmt::print("\n{}", text);
    else
        writeFile(options.out, text);
    return static_cast<int>(faulty ? ExitCode::AccuracyRegression : ExitCode::Pass); // as a test that failed
}

} // namespace
} // namespace shadowbench::faults

int main(int argc, char** argv) {
    try {
        return shadowbench::faults::run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "faults: {}\n", error.what());
        return static_cast<int>(shadowbench::ExitCode::Internal);
    }
}
