#include "harness/measure/lod_cost.h"

#include "harness/measure/raster_clock.h"
#include "harness/measure/rounds.h"
#include "harness/measure/statistics.h"
#include "techniques/catalog.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace shadowbench::lod {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(LodStage& stage, techniques::LodTechnique& technique) {
    gl::Context& context = gl::Context::current();
    context.finish();
    const double start = timing::rasterMilliseconds();
    stage.render(technique);
    context.finish();
    return timing::rasterMilliseconds() - start;
}

/// One of the two that are timed, with its least time of each frame.
struct Contestant {
    techniques::LodTechnique* technique;
    std::vector<double> least;
};

} // namespace

LodTime timeOf(const std::vector<double>& own, const std::vector<double>& base) {
    std::vector<double> ratios, changes;
    for (std::size_t i = 0; i < own.size(); ++i) {
        ratios.push_back(own[i] / base[i]);
        if (i > 0) changes.push_back(std::abs(own[i] - own[i - 1]) / own[i - 1]);
    }
    return {timing::median(own), timing::median(ratios), timing::median(changes)};
}

LodCost measureLodCost(LodStage& stage, techniques::LodTechnique& technique, int frames, const LodTimingLimits& limits) {
    const techniques::Variant base = techniques::parseVariant("lod-switch");
    const auto switching = base.entry->makeLod(base.parameters);
    std::vector<Contestant> contestants{{&technique, {}}, {switching.get(), {}}};
    stage.show(0);
    for (const Contestant& contestant : contestants) stage.render(*contestant.technique); // warm up: compiles shaders

    const auto start = Clock::now();
    std::size_t timed = static_cast<std::size_t>(frames);
    for (Contestant& contestant : contestants) contestant.least.assign(timed, std::numeric_limits<double>::infinity());
    for (int round = 0; round < limits.maximumRounds && (round == 0 || timing::secondsSince(start) < limits.budgetSeconds);
         ++round) {
        technique.reset();
        for (std::size_t frame = 0; frame < timed; ++frame) {
            stage.show(static_cast<int>(frame));
            for (Contestant& contestant : contestants)
                contestant.least[frame] = std::min(contestant.least[frame], milliseconds(stage, *contestant.technique));
            std::ranges::reverse(contestants);
            const bool enough = static_cast<int>(frame) + 1 >= limits.leastFrames;
            if (round == 0 && enough && timing::secondsSince(start) > limits.budgetSeconds) timed = frame + 1;
        }
    }
    if (contestants.front().technique != &technique) std::ranges::reverse(contestants);
    for (Contestant& contestant : contestants) contestant.least.resize(timed);
    return {timeOf(contestants[0].least, contestants[1].least), contestants[0].least};
}

} // namespace shadowbench::lod
