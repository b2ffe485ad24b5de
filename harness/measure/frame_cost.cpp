#include "harness/measure/frame_cost.h"

#include "harness/measure/statistics.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

namespace shadowbench::timing {
namespace {

std::unique_ptr<techniques::Technique> make(const techniques::Variant& variant) {
    return variant.entry->make(variant.parameters);
}

} // namespace

Time measureTime(Stage& stage, const techniques::Variant& variant, Sequence& frames, const TimingLimits& limits) {
    const auto uniformMap = make(techniques::parseVariant("sm-uniform"));
    const std::optional<techniques::Variant> baseVariant = techniques::costBase(variant);
    const auto baseTechnique = baseVariant ? make(*baseVariant) : nullptr;

    const auto frameOf = [&](techniques::Technique& t) {
        return [&stage, &t, &frames] {
            stage.redraw();
            stage.render(t, frames.index, frames.seed);
        };
    };
    Runner floor{[&stage] { stage.redraw(); }}, uniform{frameOf(*uniformMap)}, own{frameOf(frames.technique)}, base;
    if (baseTechnique) base.frame = frameOf(*baseTechnique);

    for (const Runner* runner : {&floor, &uniform, &base})
        if (runner->frame) runner->frame(); // warm up; the technique itself is warm from being scored
    timeRounds({&floor, &uniform, &own, &base}, limits, [&frames] { ++frames.index; });
    ++frames.index;

    Time time;
    time.median = median(own.samples);
    time.p95 = percentile(own.samples, 0.95);
    time.mad = medianDeviation(own.samples);
    time.ratio = median(quotients(own.samples, uniform.samples));
    time.floorRatio = median(quotients(floor.samples, own.samples));
    if (base.frame) time.baseRatio = median(quotients(own.samples, base.samples));
    time.samples = own.samples;
    return time;
}

void settle(Stage& stage, Sequence& frames) { stage.render(frames.technique, frames.index++, frames.seed); }

void measureWork(Stage& stage, Sequence& frames, Record& record) {
    const FramePasses passes = countPasses(framesOf(stage, frames));
    setWork(record, WorkOf::StandingFrame, passes.frame().work);
    record.passes = passRecords(passes, false);
}

void measureTimes(Stage& stage, const techniques::Variant& variant, Sequence& frames, Record& record) {
    FramePasses passes = countPasses(framesOf(stage, frames));
    Time time = measureTime(stage, variant, frames);
    timePasses(passes, stage, frames);
    time.processorShare = passes.processorShare();
    setTime(record, time);
    addTimes(passRecords(passes, true), record.passes);
}

} // namespace shadowbench::timing
