#include "harness/measure/frame_cost.h"

#include "harness/measure/statistics.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "techniques/gl/context.h"

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

/// Work stays that of the frame that was counted: another frame's may differ, as of a map that is turned from frame to
/// frame.
void addTimes(const PassRecord& timed, std::vector<PassRecord>& passes) {
    const auto found = std::ranges::find(passes, timed.name, &PassRecord::name);
    if (found == passes.end()) {
        passes.push_back(timed);
        return;
    }
    found->milliseconds = timed.milliseconds;
    found->share = timed.share;
    if (found->bare && timed.bare) found->bare->milliseconds = timed.bare->milliseconds;
}

struct Runner {
    std::function<void()> frame; // empty: there is no such contestant
    std::vector<double> samples;
};

/// The contestants of the rounds.
struct Runners {
    Runner floor, uniform, own, base, bare;

    [[nodiscard]] std::vector<Runner*> inOrder() {
        std::vector<Runner*> all{&floor, &uniform, &own, &base, &bare};
        std::erase_if(all, [](const Runner* runner) { return !runner->frame; });
        return all;
    }
};

} // namespace

Time measureTime(Stage& stage, const techniques::Variant& variant, Sequence& frames,
                 const std::vector<techniques::BarePass>& bare, const TimingLimits& limits) {
    const auto uniform = make(techniques::parseVariant("sm-uniform"));
    const std::optional<techniques::Variant> baseVariant = techniques::costBase(variant);
    const auto base = baseVariant ? make(*baseVariant) : nullptr;

    const auto frameOf = [&](techniques::Technique& t) {
        return [&stage, &t, &frames] {
            stage.redraw();
            stage.render(t, frames.index, frames.seed);
        };
    };
    Runners runners{{[&stage] { stage.redraw(); }, {}}, {frameOf(*uniform), {}}, {frameOf(frames.technique), {}}, {}, {}};
    if (base) runners.base.frame = frameOf(*base);
    if (!bare.empty())
        runners.bare.frame = [&] {
            stage.redraw();
            stage.renderBare(bare);
        };

    for (Runner* runner : runners.inOrder())
        if (runner != &runners.own) runner->frame(); // warm up; the technique itself is warm from being scored
    const auto start = Clock::now();
    const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    for (int round = 0; round < limits.maximumRounds; ++round) {
        if (round >= limits.minimumRounds && spent() > limits.budgetSeconds) break;
        ++frames.index;
        std::vector<Runner*> order = runners.inOrder();
        if (round % 2 == 1) std::reverse(order.begin(), order.end());
        for (Runner* runner : order) runner->samples.push_back(milliseconds(runner->frame));
    }
    ++frames.index;

    const auto& own = runners.own.samples;
    Time time;
    time.median = median(own);
    time.p95 = percentile(own, 0.95);
    time.mad = medianDeviation(own);
    time.ratio = median(quotients(own, runners.uniform.samples));
    time.floorRatio = median(quotients(runners.floor.samples, own));
    if (base) time.baseRatio = median(quotients(own, runners.base.samples));
    if (!bare.empty()) time.bare = median(runners.bare.samples);
    if (!bare.empty()) time.bareRatio = median(quotients(own, runners.bare.samples));
    time.samples = own;
    return time;
}

void settle(Stage& stage, Sequence& frames) { stage.render(frames.technique, frames.index++, frames.seed); }

void measureWork(Stage& stage, Sequence& frames, std::uint64_t bytes, Record& record) {
    const ComparedPasses passes = countPasses(stage, frames);
    const gl::WorkCount count = passes.own.frame().work;
    setWork(record, {count.fragments, count.vertices, count.primitives, count.draws, count.passes, bytes});
    record.passes = passes.records(false);
}

void measureTimes(Stage& stage, const techniques::Variant& variant, Sequence& frames, Record& record) {
    ComparedPasses passes = countPasses(stage, frames);
    Time time = measureTime(stage, variant, frames, passes.declared);
    timePasses(passes, stage, frames);
    time.processorShare = passes.own.processorShare();
    if (time.bareRatio) *time.bareRatio *= 1 - time.processorShare;
    setTime(record, time);
    for (const PassRecord& pass : passes.records(true)) addTimes(pass, record.passes);
}

} // namespace shadowbench::timing
