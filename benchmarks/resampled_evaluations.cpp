#include "benchmarks/resampled_evaluations.h"

#include <algorithm>
#include <array>

namespace shadowbench::benchmarks {
namespace {

using Rounds = std::vector<gate::PairedRound>;

Rounds exchanged(Rounds rounds, double slowdown, std::mt19937& random) {
    std::array<std::size_t, 3> who{0, 1, 2};
    std::shuffle(who.begin(), who.end(), random);
    for (gate::PairedRound& round : rounds) {
        const std::array<timing::FrameTime, 3> times{round.base, round.head, round.control};
        round = {times[who[0]], times[who[1]], times[who[2]]};
        round.head.cpu *= 1 + slowdown;
    }
    return rounds;
}

} // namespace

void count(Verdicts& verdicts, const gate::TimeJudgement& judgement) {
    switch (judgement.verdict) {
    case gate::TimeVerdict::Pass:
        ++verdicts.pass;
        break;
    case gate::TimeVerdict::Unclear:
        ++verdicts.unclear;
        break;
    case gate::TimeVerdict::Slower:
        ++verdicts.slower;
        break;
    }
    if (judgement.controlAlarm) ++verdicts.controlAlarms;
    verdicts.restarts += static_cast<int>(judgement.samples.restarts.size());
}

std::vector<Pool> pools(const std::vector<Evaluation>& evaluations) {
    std::vector<Pool> result;
    for (const Evaluation& evaluation : evaluations)
        for (const MeasuredCell& measured : evaluation.cells) {
            auto pool = std::find_if(result.begin(), result.end(), [&](const Pool& p) {
                return p.cell.scene == measured.cell.scene && p.cell.variant == measured.cell.variant;
            });
            if (pool == result.end())
                pool = result.insert(result.end(), {measured.cell, {measured.samples.framesPerTurn, {}}});
            pool->samples.restarts.insert(pool->samples.restarts.end(), measured.samples.restarts.begin(),
                                          measured.samples.restarts.end());
        }
    return result;
}

gate::TimeJudgement judgeResample(const Pool& pool, const Resampling& resampling, std::mt19937& random) {
    std::uniform_int_distribution<std::size_t> any(0, pool.samples.restarts.size() - 1);
    gate::PairedSamples samples{pool.samples.framesPerTurn, {}};
    while (!gate::enough(samples, resampling.options, resampling.cells))
        samples.restarts.push_back(exchanged(pool.samples.restarts[any(random)], resampling.slowdown, random));
    return gate::judgeSamples(pool.cell, std::move(samples), resampling.options, resampling.cells);
}

} // namespace shadowbench::benchmarks
