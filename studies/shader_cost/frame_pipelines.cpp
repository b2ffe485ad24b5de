#include "studies/shader_cost/frame_pipelines.h"

#include "base/hash.h"
#include "embedded_shader_sources.h"
#include "embedded_shaders.h"
#include "gpu/counter.h"
#include "groundtruth/contract/reference_key.h"
#include "harness/render/lod_stage.h"
#include "harness/render/motion.h"
#include "harness/render/stage.h"
#include "studies/shader_cost/shader_cost.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <utility>

namespace shadowbench::shaders {
namespace {

constexpr std::uint32_t seed = 1;

bool isSteadyDispatch(const gpu::Use& use) {
    return use.draws > 0 && use.pipeline.shaders.front().stage == gpu::Stage::Compute;
}

/// Null on a graphics processor, where fragments of one pixel may be counted at once.
std::unique_ptr<gpu::Counter> counterOf(const gl::Context& context) {
    return context.info().software ? std::make_unique<gpu::Counter>() : nullptr;
}

std::string hashOf(Snapshot snapshot, glm::ivec2 size, std::size_t transitions = 0) {
    const groundtruth::Request request(std::move(snapshot), size);
    return groundtruth::key(request, {{"transitions", std::to_string(transitions)}}).substr(0, 12);
}

/// Adds what `uses` does not have.
void addOthers(std::vector<gpu::Use>& uses, const std::vector<gpu::Use>& others) {
    for (const gpu::Use& other : others) {
        const std::string digest = other.pipeline.digest();
        const bool known = std::ranges::any_of(
            uses, [&](const gpu::Use& use) { return use.pass == other.pass && use.pipeline.digest() == digest; });
        if (!known) uses.push_back({other.pass, other.pipeline, 0});
    }
}

FrameUses ofShadow(const Scene& scene, const techniques::Variant& variant, CountedFrame which) {
    const auto counter = counterOf(gl::Context::current()); // before anything is compiled
    Stage stage(scene);
    const auto technique = variant.entry->make(variant.parameters);
    const int still = scene.timeline.still - 1;
    stage.show(still);
    gpu::Observer observer(counter.get());
    int number = 0;
    const auto render = [&] {
        stage.redraw();
        stage.render(*technique, number++, seed);
        return FrameUses{observer.take(), observer.takeMoves(), counter != nullptr};
    };
    FrameUses first = render(); // with what is done once
    if (which == CountedFrame::First) return first;
    if (which == CountedFrame::InMotion) {
        const Snapshot standing = stage.shown();
        const Casters casters = castersUnder(*variant.entry, scene);
        stage.show(displaced(standing, casters));
        (void)render();
        stage.show(returned(standing, casters));
        return render();
    }
    FrameUses steady = render();
    steady.frame = hashOf(stage.shown(), scene.size);
    addOthers(steady.uses, first.uses);
    if (scene.timeline.moving > 0) {
        stage.show(still + 1);
        addOthers(steady.uses, render().uses);
    }
    return steady;
}

FrameUses ofLevels(const Scene& scene, const techniques::Variant& variant) {
    const double aspect = static_cast<double>(scene.size.x) / scene.size.y;
    int most = 0;
    for (std::size_t frame = 0, transitions = 0; frame < static_cast<std::size_t>(scene.lod->frames); ++frame) {
        const std::size_t here = lod::walkFrame(scene, static_cast<int>(frame), aspect).inTransition();
        if (here > transitions) {
            transitions = here;
            most = static_cast<int>(frame);
        }
    }
    const auto counter = counterOf(gl::Context::current()); // before anything is compiled
    lod::LodStage stage(scene, scene.size);
    const auto technique = variant.entry->makeLod(variant.parameters);
    gpu::Observer observer(counter.get());
    const auto render = [&](int frame) {
        stage.show(frame);
        stage.render(*technique);
        return FrameUses{observer.take(), observer.takeMoves(), counter != nullptr};
    };
    const FrameUses first = render(std::max(most - 1, 0));
    FrameUses steady = render(most);
    Snapshot shown = snapshot(scene, 0); // the objects, which stand still
    shown.camera = stage.shown().camera;
    steady.frame = hashOf(std::move(shown), scene.size, stage.shown().inTransition());
    addOthers(steady.uses, first.uses);
    return steady;
}

} // namespace

const gpu::Use* FrameUses::larger(const gpu::Use& use) const {
    const auto found = std::ranges::find_if(largerDispatches, [digest = use.pipeline.digest(), &use](const gpu::Use& other) {
        return other.pass == use.pass && other.pipeline.digest() == digest;
    });
    return found == largerDispatches.end() ? nullptr : &*found;
}

FrameUses pipelinesOf(const Scene& scene, const techniques::Variant& variant, CountedFrame counted) {
    std::set<std::string>& files = gl::Context::current().shaderFiles();
    files.clear();
    FrameUses frame = variant.isLod() ? ofLevels(scene, variant) : ofShadow(scene, variant, counted);
    if (frame.isCounted && counted == CountedFrame::Standing && !variant.isLod() &&
        std::ranges::any_of(frame.uses, isSteadyDispatch)) {
        Scene large = scene;
        large.size *= largerBy;
        frame.largerDispatches = ofShadow(large, variant, CountedFrame::Standing).uses;
        std::erase_if(frame.largerDispatches, std::not_fn(isSteadyDispatch));
    }
    frame.shaderFiles = files;
    return frame;
}

std::string drawingSources() { return embedded::drawing_sources; }

std::string textsOf(const std::set<std::string>& shaderFiles) {
    std::string all;
    for (const embedded::File& file : embedded::shaders())
        if (shaderFiles.contains(std::string(file.path)))
            all += fmt::format("{} {}\n", file.path, hash128(file.text).text());
    return hash128(all).text();
}

} // namespace shadowbench::shaders
