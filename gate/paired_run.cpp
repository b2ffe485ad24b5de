#include "gate/paired_run.h"

#include "harness/measure/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <sched.h>

namespace shadowbench::gate {
namespace {

constexpr double turnMilliseconds =
    4;                         // at least: what a process finds in the caches after the others' turns is then little of it
constexpr int mostFrames = 16; // a turn
// How many times the options' restarts are done when a cell may be judged slower, each time at a share of the error. The
// smallest probability that three restarts can show is 1/27: after the first of these looks it suffices for a thousand
// cells.
constexpr std::array<int, 4> looks{3, 6, 12, 24};
constexpr auto lookCount = static_cast<int>(looks.size());

enum Contestant : std::size_t { Base, Head, Control };

/// How many frames make a turn long enough: doubled until they do.
int framesForATurn(timing::FrameWorker& base, const std::string& variant) {
    int frames = 1;
    while (frames < mostFrames && base.frames(variant, frames).cpu < turnMilliseconds) frames *= 2;
    return frames;
}

class Measurement {
public:
    Measurement(const std::filesystem::path& base, const std::filesystem::path& head, const std::vector<TimedCell>& cells,
                const PairedOptions& options, const Progress& progress)
        : base_(base), head_(head), cells_(cells), options_(options), progress_(progress), random_(options.seed) {}

    /// Adds one restart, the `restart`-th from 0, to the samples of these cells.
    void measure(const std::vector<std::size_t>& which, int restart, std::vector<PairedSamples>& samples) {
        std::size_t done = 0;
        for (const auto& ofScene : byScene(which)) {
            std::array<timing::FrameWorker, 3> workers = startWorkers(cells_[ofScene.front()].scene);
            for (const std::size_t cell : ofScene) {
                const double share = static_cast<double>(done++) / static_cast<double>(which.size());
                if (progress_) progress_(std::min(1.0, (restart + share) / options_.restarts), cells_[cell].variant);
                addRestart(workers, cells_[cell].variant, samples[cell]);
            }
        }
    }

private:
    [[nodiscard]] std::vector<std::vector<std::size_t>> byScene(const std::vector<std::size_t>& which) const {
        std::vector<std::vector<std::size_t>> groups;
        for (const std::size_t cell : which) {
            const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<std::size_t>& g) {
                return cells_[g.front()].scene == cells_[cell].scene;
            });
            if (group == groups.end())
                groups.push_back({cell});
            else
                group->push_back(cell);
        }
        return groups;
    }

    /// In a random order: whoever comes first may find another machine.
    [[nodiscard]] std::array<timing::FrameWorker, 3> startWorkers(const std::string& scene) {
        const timing::WorkerJob job{scene, options_.profile, options_.seed, sched_getcpu()};
        std::array<std::size_t, 3> order{Base, Head, Control};
        std::shuffle(order.begin(), order.end(), random_);
        std::array<std::optional<timing::FrameWorker>, 3> started;
        for (const std::size_t who : order) started[who].emplace(who == Head ? head_ : base_, job);
        return {std::move(*started[Base]), std::move(*started[Head]), std::move(*started[Control])};
    }

    void addRestart(std::array<timing::FrameWorker, 3>& workers, const std::string& variant, PairedSamples& samples) {
        for (timing::FrameWorker& worker : workers) worker.warmUp(variant);
        if (samples.restarts.empty()) {
            const int frames = samples.framesPerTurn = framesForATurn(workers[Base], variant);
            for (const Contestant other : {Head, Control}) // that all have rendered as many: 1 + 2 + … + frames
                workers[other].frames(variant, 2 * frames - 1);
        }
        samples.restarts.emplace_back();
        std::array<std::size_t, 3> order{Base, Head, Control};
        for (int round = 0; round < options_.rounds; ++round) {
            if (round % 2 == 0)
                std::shuffle(order.begin(), order.end(), random_);
            else
                std::reverse(order.begin(), order.end());
            std::array<timing::FrameTime, 3> times;
            for (const std::size_t who : order) times[who] = workers[who].frames(variant, samples.framesPerTurn);
            samples.restarts.back().push_back({times[Base], times[Head], times[Control]});
        }
    }

    const std::filesystem::path &base_, &head_;
    const std::vector<TimedCell>& cells_;
    const PairedOptions& options_;
    const Progress& progress_;
    std::mt19937 random_;
};

TimeRule ofWallTime(TimeRule rule) {
    rule.floor = rule.wallFloor;
    return rule;
}

/// CPU time and wall time of each cell: α is split between them.
int testsOf(int cells) { return 2 * cells; }

TimeVerdict cpuVerdict(const std::vector<RestartTimes>& restarts, const TimeRule& rule, int cells) {
    return judgeTime(restarts, rule, testsOf(cells), lookCount);
}

TimeVerdict wallVerdict(const PairedSamples& samples, const TimeRule& rule, int cells) {
    return judgeTime(restartTimes(samples, &timing::FrameTime::wall), ofWallTime(rule), testsOf(cells), lookCount);
}

void judgeWallTime(const PairedSamples& samples, const TimeRule& rule, int cells, TimeJudgement& judgement) {
    judgement.wallRatio = std::exp(logSlowdown(restartTimes(samples, &timing::FrameTime::wall)));
    judgement.waits =
        judgement.verdict != TimeVerdict::Slower && wallVerdict(samples, rule, cells) == TimeVerdict::Slower &&
        !controlAlarms(logRatios(samples, &PairedRound::control, &timing::FrameTime::wall), ofWallTime(rule), cells);
}

} // namespace

std::vector<double> logRatios(const PairedSamples& samples, timing::FrameTime PairedRound::*who,
                              double timing::FrameTime::*clock) {
    std::vector<double> ratios;
    for (const auto& rounds : samples.restarts)
        for (const PairedRound& round : rounds) ratios.push_back(std::log((round.*who).*clock / round.base.*clock));
    return ratios;
}

std::vector<RestartTimes> restartTimes(const PairedSamples& samples, double timing::FrameTime::*clock) {
    std::vector<RestartTimes> result;
    for (const auto& rounds : samples.restarts) {
        std::array<std::vector<double>, 3> times; // of two rounds, without what both share
        for (std::size_t i = 0; i < rounds.size(); i += 2) {
            std::array<double, 3> both{};
            for (const PairedRound& round : {rounds[i], rounds[std::min(i + 1, rounds.size() - 1)]}) {
                both[Base] += std::log(round.base.*clock) / 2;
                both[Head] += std::log(round.head.*clock) / 2;
                both[Control] += std::log(round.control.*clock) / 2;
            }
            const double shared = (both[Base] + both[Head] + both[Control]) / 3;
            for (std::size_t who = 0; who < both.size(); ++who) times[who].push_back(both[who] - shared);
        }
        result.push_back({hodgesLehmann(times[Base]), hodgesLehmann(times[Head]), hodgesLehmann(times[Control])});
    }
    return result;
}

bool enough(const PairedSamples& samples, const PairedOptions& options, int cells) {
    const auto done = static_cast<int>(samples.restarts.size());
    if (done == 0 || done % options.restarts != 0) return false;
    const int times = done / options.restarts;
    if (times >= looks.back()) return true;
    const bool look = std::ranges::find(looks, times) != looks.end();
    const auto decided = [&](TimeVerdict verdict) {
        return verdict == TimeVerdict::Pass || (look && verdict == TimeVerdict::Slower);
    };
    const TimeVerdict verdict = cpuVerdict(restartTimes(samples), options.rule, cells);
    return decided(verdict) && (verdict == TimeVerdict::Slower || decided(wallVerdict(samples, options.rule, cells)));
}

TimeJudgement judgeSamples(const TimedCell& cell, PairedSamples samples, const PairedOptions& options, int cells) {
    const std::vector<RestartTimes> restarts = restartTimes(samples);
    TimeJudgement judgement;
    judgement.cell = cell;
    const double alpha = options.rule.alpha / testsOf(cells) / lookCount;
    judgement.verdict = cpuVerdict(restarts, options.rule, cells);
    judgement.ratio = std::exp(logSlowdown(restarts));
    if (judgement.verdict == TimeVerdict::Slower) judgement.lowerBound = std::exp(slowdownLowerBound(restarts, alpha));
    judgement.smallestTold = smallestTold(restarts, options.rule, alpha, looks.back() * options.restarts);
    for (const auto& rounds : samples.restarts) judgement.rounds += static_cast<int>(rounds.size());
    judgement.controlAlarm = controlAlarms(logRatios(samples, &PairedRound::control), options.rule, cells);
    judgeWallTime(samples, options.rule, cells, judgement);
    judgement.samples = std::move(samples);
    return judgement;
}

std::vector<TimeJudgement> judgePairedTime(const std::filesystem::path& base, const std::filesystem::path& head,
                                           const std::vector<TimedCell>& cells, const PairedOptions& options,
                                           const Progress& progress) {
    Measurement measurement(base, head, cells, options, progress);
    const auto count = static_cast<int>(cells.size());
    std::vector<PairedSamples> samples(cells.size());
    std::vector<std::size_t> open(cells.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    for (int restart = 0; !open.empty(); ++restart) {
        measurement.measure(open, restart, samples);
        std::erase_if(open, [&](std::size_t cell) { return enough(samples[cell], options, count); });
    }
    std::vector<TimeJudgement> judgements;
    for (std::size_t i = 0; i < cells.size(); ++i)
        judgements.push_back(judgeSamples(cells[i], std::move(samples[i]), options, count));
    return judgements;
}

} // namespace shadowbench::gate
