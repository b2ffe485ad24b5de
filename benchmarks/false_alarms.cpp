// How often the gate's paired-time tier errs: gates of a program against itself, or against a slower one, again and again.
//
//   false_alarms --base PROGRAM [--head PROGRAM] [--name quiet] [--evaluations 20] [--loaders 0] [--cell "SCENE VARIANT"]…
//                [--samples FOLDER] [--out FILE]
//
// Without --head a copy of the base is the head: every alarm is a false one. All samples are kept in FOLDER/NAME.jsonl, one
// evaluation a line; a run adds what is missing to --evaluations, so one that was killed goes on. The report is about all
// experiments in the folder; --evaluations 0 only writes it.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "benchmarks/false_alarms_report.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fmt/format.h>
#include <thread>

namespace shadowbench::benchmarks {
namespace {

constexpr int resamples = 5'000;

struct Settings {
    std::filesystem::path base, head, samples = "false-alarms-samples", out;
    std::string name = "quiet";
    std::vector<std::string> cells{"dueling-frusta sm-uniform",  "dueling-frusta volume-zfail",
                                   "dueling-frusta pcf",         "overlapping-occluders sm-cascaded",
                                   "overlapping-occluders pcss", "overlapping-occluders sm-history",
                                   "simple planar-hard",         "simple sm-silhouette"};
    int evaluations = 20, loaders = 0;
};

std::vector<gate::TimedCell> cellsNamed(const std::vector<std::string>& names) {
    std::vector<gate::TimedCell> cells;
    for (const std::string& name : names) {
        const std::size_t space = name.find(' ');
        if (space == std::string::npos) throw BadInput(fmt::format("--cell \"{}\" is not a scene and a variant", name));
        cells.push_back({name.substr(0, space), name.substr(space + 1)});
    }
    return cells;
}

/// Threads that load a core each while it lives.
class Load {
public:
    explicit Load(int cores) {
        for (int i = 0; i < cores; ++i)
            threads_.emplace_back([](const std::stop_token& stop) {
                for (std::atomic<unsigned> turns = 0; !stop.stop_requested();) ++turns;
            });
    }

private:
    std::vector<std::jthread> threads_;
};

double loadAverage() {
    double lastMinute = 0;
    return getloadavg(&lastMinute, 1) == 1 ? lastMinute : 0;
}

Evaluation evaluate(const std::filesystem::path& base, const std::filesystem::path& head, const Settings& settings,
                    std::uint32_t seed) {
    gate::PairedOptions options;
    options.seed = seed;
    Evaluation evaluation{seed, settings.head.empty(), settings.loaders, 0, {}};
    for (gate::TimeJudgement& judgement : gate::judgePairedTime(base, head, cellsNamed(settings.cells), options, {})) {
        if (judgement.verdict == gate::TimeVerdict::Slower)
            fmt::print("slower: {} on {}, {:.3f}, at least {:.3f}\n", judgement.cell.variant, judgement.cell.scene,
                       judgement.ratio, judgement.lowerBound);
        evaluation.cells.push_back({judgement.cell, std::move(judgement.samples)});
    }
    evaluation.loadAverage = loadAverage();
    return evaluation;
}

void measure(const Settings& settings) {
    const std::filesystem::path file = settings.samples / (settings.name + ".jsonl");
    const TemporaryFolder folder;
    const std::filesystem::path base = std::filesystem::absolute(settings.base), copy = folder.path() / "shadowbench";
    if (settings.head.empty()) std::filesystem::copy_file(base, copy);
    const std::filesystem::path head = settings.head.empty() ? copy : std::filesystem::absolute(settings.head);
    const Load load(settings.loaders);
    for (auto seed = static_cast<std::uint32_t>(readEvaluations(file).size()) + 1;
         seed <= static_cast<std::uint32_t>(settings.evaluations) && !DeferredInterrupts::pending(); ++seed) {
        appendEvaluation(file, evaluate(base, head, settings, seed));
        fmt::print("{}: {} of {} evaluations, load average {:.1f}\n", settings.name, seed, settings.evaluations,
                   loadAverage());
        std::fflush(stdout);
    }
}

std::vector<Experiment> experiments(const std::filesystem::path& folder) {
    std::vector<Experiment> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".jsonl")
            found.push_back({entry.path().stem().string(), readEvaluations(entry.path())});
    std::erase_if(found, [](const Experiment& e) { return e.evaluations.empty(); });
    std::ranges::sort(found, {}, &Experiment::name);
    return found;
}

int run(int argc, char** argv) {
    Settings settings;
    CLI::App app("Errors of the paired-time tier.", "false_alarms");
    app.add_option("--base", settings.base)->check(CLI::ExistingFile);
    app.add_option("--head", settings.head)->check(CLI::ExistingFile);
    app.add_option("--name", settings.name, "of the experiment");
    app.add_option("--evaluations", settings.evaluations)->check(CLI::NonNegativeNumber);
    app.add_option("--loaders", settings.loaders, "threads that load a core each")->check(CLI::NonNegativeNumber);
    app.add_option("--cell", settings.cells, "scene and variant")->allow_extra_args(false);
    app.add_option("--samples", settings.samples);
    app.add_option("--out", settings.out, "Markdown; standard output without it");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    }
    if (settings.evaluations > 0) {
        if (settings.base.empty()) throw BadInput("--base is missing: the program to time");
        measure(settings);
    }
    const std::string text = errorReport(experiments(settings.samples), {}, resamples);
    if (settings.out.empty())
        fmt::print("{}", text);
    else
        writeFile(settings.out, text);
    return 0;
}

} // namespace
} // namespace shadowbench::benchmarks

int main(int argc, char** argv) {
    try {
        return shadowbench::benchmarks::run(argc, argv);
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "false_alarms: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        fmt::print(stderr, "false_alarms: {}\n", error.what());
        return 1;
    }
}
