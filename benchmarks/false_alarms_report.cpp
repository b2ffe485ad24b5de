#include "benchmarks/false_alarms_report.h"

#include "benchmarks/resampled_evaluations.h"
#include "harness/measure/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace shadowbench::benchmarks {
namespace {

constexpr std::uint32_t resamplingSeed = 1;
constexpr int largeGate = 100; // cells

/// "3 of 200 (≤ 3.8 %)": the bound holds with probability 95 %.
std::string share(int events, int trials) {
    using boost::math::binomial;
    const double bound = events == trials ? 1 : binomial::find_upper_bound_on_p(trials, events, 0.05);
    return fmt::format("{} of {} (≤ {} %)", events, trials,
                       bound > 0.1 ? fmt::format("{:.0f}", 100 * bound) : fmt::format("{:.2g}", 100 * bound));
}

std::string percent(int events, int trials) { return fmt::format("{:.2f} %", 100.0 * events / trials); }

/// Standard deviation of the rounds' log-ratios, from the quartiles: of equal programs, or of the control.
double spread(const Pool& pool) {
    const std::vector<double> ratios = logRatios(pool.samples, &gate::PairedRound::control);
    return (timing::percentile(ratios, 0.75) - timing::percentile(ratios, 0.25)) / 1.349;
}

/// The same of a restart, in which rounds are alike: of its difference between base and control.
double restartSpread(const Pool& pool) {
    double squares = 0;
    const std::vector<gate::RestartTimes> restarts = restartTimes(pool.samples);
    for (const gate::RestartTimes& times : restarts) squares += std::pow(times.control - times.base, 2);
    return std::sqrt(squares / static_cast<double>(restarts.size()));
}

gate::TimeJudgement judged(const MeasuredCell& measured, const Evaluation& evaluation, const gate::PairedOptions& options) {
    return gate::judgeSamples(measured.cell, measured.samples, options, static_cast<int>(evaluation.cells.size()));
}

struct Counted {
    Verdicts cells;
    int evaluations = 0, withAlarm = 0, withControlAlarm = 0, rounds = 0;
    double load = 0; // mean
};

Counted countMeasured(const Experiment& experiment, const gate::PairedOptions& options) {
    Counted counted;
    for (const Evaluation& evaluation : experiment.evaluations) {
        Verdicts verdicts;
        for (const MeasuredCell& measured : evaluation.cells) {
            const gate::TimeJudgement judgement = judged(measured, evaluation, options);
            count(verdicts, judgement);
            counted.rounds += judgement.rounds;
        }
        counted.cells.pass += verdicts.pass;
        counted.cells.unclear += verdicts.unclear;
        counted.cells.slower += verdicts.slower;
        counted.cells.controlAlarms += verdicts.controlAlarms;
        counted.withAlarm += verdicts.slower > 0 ? 1 : 0;
        counted.withControlAlarm += verdicts.controlAlarms > 0 ? 1 : 0;
        ++counted.evaluations;
        counted.load += evaluation.loadAverage / static_cast<double>(experiment.evaluations.size());
    }
    return counted;
}

bool samePrograms(const Experiment& experiment) { return experiment.evaluations.front().samePrograms; }

std::string measuredTable(const std::vector<Experiment>& experiments, const gate::PairedOptions& options) {
    std::string text =
        "| experiment | programs | loaders | load average | cells judged | rounds | slower | evaluations with one "
        "| unclear | control alarms | evaluations with one |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const Experiment& experiment : experiments) {
        const Counted c = countMeasured(experiment, options);
        const int cells = c.cells.all();
        text += fmt::format("| {} | {} | {} | {:.1f} | {} | {} | {} | {} | {} | {} | {} |\n", experiment.name,
                            samePrograms(experiment) ? "equal" : "different", experiment.evaluations.front().loaders, c.load,
                            cells, c.rounds, share(c.cells.slower, cells), share(c.withAlarm, c.evaluations),
                            percent(c.cells.unclear, cells), share(c.cells.controlAlarms, cells),
                            share(c.withControlAlarm, c.evaluations));
    }
    return text;
}

std::string cellTable(const Experiment& experiment, const gate::PairedOptions& options) {
    std::string text = fmt::format("\n### {}\n\n| scene | technique | ms a frame | frames a turn | sd of a round | sd of a "
                                   "restart | restarts | slower | unclear |\n|---|---|--:|--:|--:|--:|--:|--:|--:|\n",
                                   experiment.name);
    for (const Pool& pool : pools(experiment.evaluations)) {
        std::vector<double> base;
        for (const auto& rounds : pool.samples.restarts)
            for (const gate::PairedRound& round : rounds) base.push_back(round.base.cpu / pool.samples.framesPerTurn);
        Verdicts verdicts;
        for (const Evaluation& evaluation : experiment.evaluations)
            for (const MeasuredCell& measured : evaluation.cells)
                if (measured.cell.scene == pool.cell.scene && measured.cell.variant == pool.cell.variant)
                    count(verdicts, judged(measured, evaluation, options));
        text += fmt::format("| {} | `{}` | {:.2f} | {} | {:.1f} % | {:.1f} % | {} | {} of {} | {} |\n", pool.cell.scene,
                            pool.cell.variant, timing::median(base), pool.samples.framesPerTurn, 100 * spread(pool),
                            100 * restartSpread(pool), pool.samples.restarts.size(), verdicts.slower, verdicts.all(),
                            verdicts.unclear);
    }
    return text;
}

Verdicts resampled(const std::vector<Pool>& cells, const Resampling& resampling, int resamples) {
    std::mt19937 random(resamplingSeed);
    Verdicts verdicts;
    for (int i = 0; i < resamples; ++i)
        count(verdicts, judgeResample(cells[static_cast<std::size_t>(i) % cells.size()], resampling, random));
    return verdicts;
}

/// False alarms are rare: it takes more cells to see any.
int cellsFor(double slowdown, int resamples) { return slowdown > 0 ? resamples : 20 * resamples; }

std::string resampledTable(const std::vector<Experiment>& experiments, const gate::PairedOptions& options, int resamples) {
    std::string text =
        "| experiment | cells a gate | head slower by | judged slower | gates with one | unclear | control alarms "
        "| restarts a cell |\n|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const Experiment& experiment : experiments) {
        if (!samePrograms(experiment)) continue;
        const std::vector<Pool> cells = pools(experiment.evaluations);
        for (const int sharing : {static_cast<int>(cells.size()), largeGate})
            for (const double slowdown : {0.0, 0.01, 0.03, 0.05}) {
                const int trials = cellsFor(slowdown, resamples);
                const Verdicts v = resampled(cells, {options, sharing, slowdown}, trials);
                const double gates = 1 - std::pow(1 - static_cast<double>(v.slower) / trials, sharing);
                text += fmt::format("| {} | {} | {:.0f} % | {} of {}: {} | {} | {} | {} | {:.1f} |\n", experiment.name,
                                    sharing, 100 * slowdown, v.slower, trials, percent(v.slower, trials),
                                    slowdown > 0 ? "" : fmt::format("{:.2f} %", 100 * gates), percent(v.unclear, trials),
                                    percent(v.controlAlarms, trials), static_cast<double>(v.restarts) / trials);
            }
    }
    return text;
}

} // namespace

std::string errorReport(const std::vector<Experiment>& experiments, const gate::PairedOptions& options, int resamples) {
    std::string text = fmt::format(
        "# How often paired time errs\n\nMade by `false_alarms` (benchmarks/); docs/gate.md, "
        "\"Time\", says what the rule and the experiments are.\nEach evaluation is a gate: {} restarts of three workers, "
        "{} rounds a restart, as many again while that\nleaves a cell unclear (the restarts measured are those "
        "that the rule of their day took), floor {:.0f} %, α = {:.0f} % over the\ncells of an evaluation. Bounds "
        "in brackets hold with probability 95 %. Seeds are 1, 2, 3 … for the "
        "evaluations.\n\n## Measured\n\n",
        options.restarts, options.rounds, 100 * options.rule.floor, 100 * options.rule.alpha);
    text += measuredTable(experiments, options);
    text += fmt::format(
        "\n## Resampled\n\nEach line judges cells made of the restarts measured above with equal programs, drawn with "
        "replacement\n(seed {}); base, head and control change places at random, then the head's times are made "
        "longer by the given share.\n\n",
        resamplingSeed);
    text += resampledTable(experiments, options, resamples);
    text += "\n## Cells\n";
    for (const Experiment& experiment : experiments) text += cellTable(experiment, options);
    return text;
}

} // namespace shadowbench::benchmarks
