// faults: makes calls of the program fail, kills it, and runs it beside itself; reports what becomes of files and records.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "tools/faults/failing_calls.h"
#include "tools/faults/kills.h"
#include "tools/faults/together.h"
#include "tools/faults/write_order.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <random>

namespace shadowbench::faults {
namespace {

namespace fs = std::filesystem;

struct Options {
    fs::path program = PROGRAM, out;
    std::vector<std::string> verbs{"run", "gate", "reference", "merge", "score", "report"};
    std::vector<std::string> killed;
    std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    bool lasting = false;
    int kills = 200, processes = 10;
    unsigned seed = 1;
};

void show(const Trial& trial) {
    fmt::print("{:<10} {:<24} {:>6} {:>4}  {}\n", trial.verb, trial.call, trial.number, trial.code, trial.said);
    for (const std::string& fault : trial.faults) fmt::print("    FAULT {} ({})\n", fault, trial.what);
    std::fflush(stdout);
}

/// The report goes into the file, or to the terminal; a fault is the exit code of a test that failed.
ExitCode end(const std::string& report, const fs::path& out, bool faulty) {
    if (out.empty())
        fmt::print("\n{}", report);
    else
        writeFile(out, report);
    return faulty ? ExitCode::AccuracyRegression : ExitCode::Pass;
}

bool anyFaulty(const std::vector<Trial>& trials) {
    return std::ranges::any_of(trials, [](const Trial& trial) { return !trial.faults.empty(); });
}

/// The verbs, as the command line names them.
std::string chosen(const Options& options) {
    return options.killed.empty() ? "" : fmt::format(" --verb \"{}\"", fmt::join(options.killed, ","));
}

ExitCode failCalls(const Options& options) {
    const std::vector<Verb> verbs = verbsNamed(options.verbs);
    Sandbox sandbox(options.program, verbs);
    std::string command = fmt::format("build/release/tools/faults/faults calls --verb {}", fmt::join(options.verbs, ","));
    if (options.most < std::numeric_limits<std::uint64_t>::max()) command += fmt::format(" --most {}", options.most);
    if (options.lasting) command += " --lasting";
    std::vector<Trial> trials;
    const auto keep = [&](Trial trial) {
        show(trial);
        trials.push_back(std::move(trial));
    };
    for (const Verb& verb : verbs) {
        if (!trials.empty() && !options.out.empty()) // the whole takes hours: what there is can be read
            writeFile(options.out, callsReport(trials, command + " (not finished)"));
        std::map<Kind, std::uint64_t> counts = countCalls(sandbox, verb);
        for (const Kind kind : {Kind::Open, Kind::Write, Kind::Rename, Kind::Fsync, Kind::Fork, Kind::Thread, Kind::Pipe}) {
            const std::uint64_t count = counts[kind];
            for (const std::uint64_t number : spread(count, options.most))
                keep(failCall(sandbox, verb, kind, number, count, false));
            if (options.lasting && count > 0) keep(failCall(sandbox, verb, kind, 1 + count / 2, count, true));
        }
        for (std::uint64_t number = 1;; number *= 2) {
            auto trial = failAllocation(sandbox, verb, number);
            if (!trial) break;
            keep(std::move(*trial));
        }
    }
    return end(callsReport(trials, command), options.out, anyFaulty(trials));
}

ExitCode killVerbs(const Options& options) {
    const std::vector<Verb> verbs = verbsNamed(options.killed);
    Sandbox sandbox(options.program, verbs);
    std::vector<std::uint64_t> moments;
    for (const Verb& verb : verbs) moments.push_back(countMoments(sandbox, verb));
    std::mt19937 random(options.seed);
    std::vector<Trial> trials;
    const std::string command =
        fmt::format("build/release/tools/faults/faults kills {} --seed {}", options.kills, options.seed) + chosen(options);
    for (int i = 0; i < options.kills; ++i) {
        if (i > 0 && i % 10 == 0 && !options.out.empty()) // see failCalls
            writeFile(options.out, killsReport(trials, command + " (not finished)"));
        const std::size_t v = static_cast<std::size_t>(i) % verbs.size(); // each as often
        trials.push_back(killAt(sandbox, verbs[v], drawKill(random, moments[v]), moments[v]));
        show(trials.back());
    }
    return end(killsReport(trials, command), options.out, anyFaulty(trials));
}

ExitCode checkOrder(const Options& options) {
    const std::vector<Verb> verbs = verbsNamed(options.killed);
    Sandbox sandbox(options.program, verbs);
    std::vector<std::pair<std::string, WriteOrder>> orders;
    for (const Verb& verb : verbs) {
        const WriteOrder& order = orders.emplace_back(verb.name, writeOrderOf(sandbox, verb)).second;
        fmt::print("{:<10} {} files are flushed before their rename and their folders after it, {} are made again\n",
                   verb.name, order.renames, order.madeAgain);
        for (const std::string& fault : order.faults) fmt::print("    FAULT {}\n", fault);
        std::fflush(stdout);
    }
    return end(orderReport(orders, "build/release/tools/faults/faults order" + chosen(options)), options.out,
               std::ranges::any_of(orders, [](const auto& order) { return !order.second.faults.empty(); }));
}

ExitCode runTogether(const Options& options) {
    const Together together = workTogether(options.program, options.processes, [](const std::string& sentence) {
        fmt::print("{}\n", sentence);
        std::fflush(stdout);
    });
    return end(togetherReport(together, fmt::format("build/release/tools/faults/faults together {}", options.processes)),
               options.out, !together.faults.empty());
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
    calls->add_option("--verb", options.verbs, "Comma-separated")->delimiter(',')->capture_default_str();
    calls->add_option("--most", options.most, "Of each kind at most so many, evenly (default: all)");
    calls->add_flag("--lasting", options.lasting, "From the middle one on all of a kind, too: a disk that stays full");
    CLI::App* kills = app.add_subcommand("kills", "Kills verbs and their processes at calls that are drawn by chance");
    kills->add_option("number", options.kills, "How many")->capture_default_str();
    kills->add_option("--seed", options.seed, "Of the random numbers")->capture_default_str();
    CLI::App* order =
        app.add_subcommand("order", "Sees that files are flushed before they are renamed, and folders after it");
    for (CLI::App* verb : {kills, order})
        verb->add_option("--verb", options.killed, "Comma-separated (default: all that write)")->delimiter(',');
    CLI::App* together =
        app.add_subcommand("together", "Runs, gates, scores, merges, reports and prunes at once on one cache "
                                       "and one output");
    together->add_option("number", options.processes, "Of each at once")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    if (calls->parsed()) return static_cast<int>(failCalls(options));
    if (kills->parsed()) return static_cast<int>(killVerbs(options));
    if (order->parsed()) return static_cast<int>(checkOrder(options));
    return static_cast<int>(runTogether(options));
}

} // namespace
} // namespace shadowbench::faults

int main(int argc, char** argv) {
    try {
        return shadowbench::faults::run(argc, argv);
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "faults: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        fmt::print(stderr, "faults: internal error: {}\n", error.what());
        return static_cast<int>(shadowbench::ExitCode::Internal);
    }
}
