#include "harness/measure/frame_cost.h"

#include "harness/measure/statistics.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

namespace shadowbench::timing {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(const std::function<void()>& work) {
    gl::Context& context = gl::Context::current();
    context.finish();
    const auto start = Clock::now();
    work();
    context.finish();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::unique_ptr<techniques::Technique> make(const techniques::Variant& variant) {
    return variant.entry->make(variant.parameters);
}

std::vector<double> quotients(const std::vector<double>& numerators, const std::vector<double>& denominators) {
    std::vector<double> result(numerators.size());
    std::transform(numerators.begin(), numerators.end(), denominators.begin(), result.begin(), std::divides<>());
    return result;
}

/// The contestants of the rounds, in the order they are made; Base is not always there.
enum Contestant : std::size_t { Floor, Uniform, Own, Base };

struct Runner {
    std::function<void()> frame;
    std::vector<double> samples;
};

} // namespace

Time measureTime(Stage& stage, const techniques::Variant& variant, techniques::Technique& technique, int index,
                 std::uint32_t seed, const TimingLimits& limits) {
    const auto uniform = make(techniques::parseVariant("sm-uniform"));
    const std::optional<techniques::Variant> baseVariant = techniques::costBase(variant);
    const auto base = baseVariant ? make(*baseVariant) : nullptr;

    int next = index;
    const auto frameOf = [&](techniques::Technique& t) {
        return [&stage, &t, &next, seed] {
            stage.redraw();
            stage.render(t, next, seed);
        };
    };
    std::vector<Runner> runners{{[&stage] { stage.redraw(); }, {}}, {frameOf(*uniform), {}}, {frameOf(technique), {}}};
    if (base) runners.push_back({frameOf(*base), {}});

    for (Runner& runner : runners)
        if (&runner != &runners[Own]) runner.frame(); // warm up; the technique itself is warm from being scored
    const auto start = Clock::now();
    const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    for (int round = 0; round < limits.maximumRounds; ++round) {
        if (round >= limits.minimumRounds && spent() > limits.budgetSeconds) break;
        ++next;
        std::vector<Runner*> order;
        for (Runner& runner : runners) order.push_back(&runner);
        if (round % 2 == 1) std::reverse(order.begin(), order.end());
        for (Runner* runner : order) runner->samples.push_back(milliseconds(runner->frame));
    }

    const auto& floor = runners[Floor].samples;
    const auto& own = runners[Own].samples;
    Time time;
    time.median = median(own);
    time.p95 = percentile(own, 0.95);
    time.mad = medianDeviation(own);
    time.ratio = median(quotients(own, runners[Uniform].samples));
    time.floorRatio = median(quotients(floor, own));
    if (base) time.baseRatio = median(quotients(own, runners[Base].samples));
    time.samples = own;
    return time;
}

Work measureWork(Stage& stage, techniques::Technique& technique, std::uint64_t bytes, int index, std::uint32_t seed) {
    gl::WorkMeter meter;
    stage.redraw();
    stage.render(technique, index, seed);
    const gl::WorkCount count = meter.finish();
    return {count.fragments, count.vertices, count.primitives, count.draws, count.passes, bytes};
}

} // namespace shadowbench::timing
