#include "harness/measure/frame_passes.h"

#include "harness/measure/warm_frames.h"

#include <algorithm>

namespace shadowbench::timing {
namespace {

// Of timing a frame's passes: parts of a frame, of which the whole is timed more often. A frame that takes longer than the
// budget is timed once: so long a time varies little.
constexpr int passRounds = 5;
constexpr double budgetMilliseconds = 100;

RenderFrame bareFramesOf(Stage& stage, const std::vector<techniques::BarePass>& passes) {
    return [&](techniques::PassListener& listener) {
        stage.redraw(&listener);
        stage.renderBare(passes, &listener);
    };
}

/// What is declared of one pass, as one: sources joined, reads added up.
BareCost declaredOf(const std::vector<techniques::BarePass>& declared, const std::string& pass) {
    BareCost cost;
    for (const techniques::BarePass& bare : declared) {
        if (bare.pass != pass) continue;
        cost.taps += bare.tapsRead();
        if (cost.source.find(bare.source) == std::string::npos)
            cost.source += (cost.source.empty() ? "" : "; ") + bare.source;
    }
    return cost;
}

PassRecord recordOf(const PassCost& pass, double frameTime, bool timed) {
    PassRecord record{.name = pass.name, .runs = pass.runs};
    if (timed) record.milliseconds = pass.milliseconds;
    if (timed && frameTime > 0) record.share = pass.milliseconds / frameTime;
    record.fragments = pass.work.fragments;
    record.vertices = pass.work.vertices;
    record.draws = pass.work.draws;
    return record;
}

} // namespace

RenderFrame framesOf(Stage& stage, Sequence& frames) {
    return [&](techniques::PassListener& listener) {
        stage.redraw(&listener);
        stage.render(frames.technique, frames.index++, frames.seed, &listener);
    };
}

std::vector<PassRecord> passRecords(const FramePasses& passes, bool timed) {
    const double all = passes.frame().milliseconds;
    std::vector<PassRecord> records;
    for (const PassCost& pass : passes.passes) records.push_back(recordOf(pass, all, timed));
    PassCost between = passes.outside;
    between.name = betweenPasses;
    between.runs = 1;
    records.push_back(recordOf(between, all, timed));
    return records;
}

void addTimes(const std::vector<PassRecord>& timed, std::vector<PassRecord>& passes) {
    for (const PassRecord& pass : timed) {
        const auto found = std::ranges::find(passes, pass.name, &PassRecord::name);
        if (found == passes.end()) {
            passes.push_back(pass);
            continue;
        }
        found->milliseconds = pass.milliseconds;
        found->share = pass.share;
        if (found->bare && pass.bare) found->bare->milliseconds = pass.bare->milliseconds;
    }
}

std::vector<PassRecord> ComparedPasses::records(bool timed) const {
    std::vector<PassRecord> records = passRecords(own, timed);
    for (PassRecord& record : records) {
        BareCost cost = declaredOf(declared, record.name);
        const auto drawn = std::ranges::find(bare.passes, record.name, &PassCost::name);
        if (cost.source.empty() || drawn == bare.passes.end()) continue;
        if (timed) cost.milliseconds = drawn->milliseconds;
        cost.fragments = drawn->work.fragments;
        cost.vertices = drawn->work.vertices;
        record.bare = cost;
    }
    return records;
}

ComparedPasses countPasses(Stage& stage, Sequence& frames) {
    ComparedPasses result;
    result.own = countPasses(framesOf(stage, frames));
    result.declared = frames.technique.bare(stage.frame(frames.index - 1, frames.seed));
    if (!result.declared.empty()) result.bare = countPasses(bareFramesOf(stage, result.declared));
    return result;
}

void timePasses(ComparedPasses& counted, Stage& stage, Sequence& frames) {
    timePasses(counted.own, framesOf(stage, frames), passRounds, budgetMilliseconds);
    if (!counted.declared.empty())
        timePasses(counted.bare, bareFramesOf(stage, counted.declared), passRounds, budgetMilliseconds);
}

OtherScreen measureOtherScreen(const Scene& scene, const techniques::Variant& variant, int frame, std::uint32_t seed) {
    constexpr int large = 1024, small = 256;
    const int longer = std::max(scene.size.x, scene.size.y);
    Scene other = scene;
    other.size = glm::max(scene.size * (longer < large ? large : small) / longer, glm::ivec2(1));
    Stage stage(other);
    stage.show(frame);
    const auto technique = variant.entry->make(variant.parameters);
    Sequence frames{*technique, 0, seed};
    for (; frames.index < warmFrames; ++frames.index) stage.render(*technique, frames.index, seed);
    ComparedPasses passes = countPasses(stage, frames);
    timePasses(passes, stage, frames);
    return {other.size.x, other.size.y, passes.records(true)};
}

} // namespace shadowbench::timing
