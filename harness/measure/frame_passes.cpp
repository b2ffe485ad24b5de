#include "harness/measure/frame_passes.h"

#include "harness/measure/warm_frames.h"

#include <algorithm>

namespace shadowbench::timing {
namespace {

// Of timing a frame's passes: parts of a frame, of which the whole is timed more often. A frame that takes longer than the
// budget is timed once: so long a time varies little.
constexpr int passRounds = 5;
constexpr double budgetMilliseconds = 100;

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
    }
}

void timePasses(FramePasses& counted, Stage& stage, Sequence& frames) {
    timePasses(counted, framesOf(stage, frames), passRounds, budgetMilliseconds);
}

glm::ivec2 otherScreen(const Scene& scene) {
    constexpr int large = 1024, small = 256;
    const int longer = std::max(scene.size.x, scene.size.y);
    return glm::max(scene.size * (longer < large ? large : small) / longer, glm::ivec2(1));
}

OtherScreen measureOtherScreen(const Scene& scene, const techniques::Variant& variant, int frame, std::uint32_t seed) {
    Scene other = scene;
    other.size = otherScreen(scene);
    Stage stage(other);
    stage.show(frame);
    const auto technique = variant.entry->make(variant.parameters);
    Sequence frames{*technique, 0, seed};
    for (; frames.index < warmFrames; ++frames.index) stage.render(*technique, frames.index, seed);
    FramePasses passes = countPasses(framesOf(stage, frames));
    timePasses(passes, stage, frames);
    return {other.size.x, other.size.y, passRecords(passes, true)};
}

} // namespace shadowbench::timing
