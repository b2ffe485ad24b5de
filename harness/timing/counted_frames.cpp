// The half of instruction counting that runs under Callgrind.
#include "harness/lod/lod_stage.h"
#include "harness/run/stage.h"
#include "harness/scene/error.h"
#include "harness/timing/callgrind.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <valgrind/callgrind.h>

namespace shadowbench::timing {
namespace {

constexpr int warmFrames = 2; // the first compiles shaders, the second meets what the first left

/// Counts what `frame` does, under the name of `variant`.
void count(const techniques::Variant& variant, const std::function<void()>& frame) {
    gl::Context::current().finish();
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
    frame();
    gl::Context::current().finish();
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_STOP_INSTRUMENTATION;
    CALLGRIND_DUMP_STATS_AT(variant.name.c_str());
}

/// One scene's techniques of either kind; what a kind needs is made when the first of it comes.
class CountedScene {
public:
    CountedScene(const Scene& scene, std::uint32_t seed) : scene_(scene), seed_(seed) {}

    void countFrame(const techniques::Variant& variant) {
        if (variant.isLod())
            countWalkFrame(variant);
        else
            countShadowFrame(variant);
    }

private:
    void countShadowFrame(const techniques::Variant& variant) {
        if (!stage_) {
            stage_.emplace(scene_);
            stage_->show(scene_.timeline.still - 1);
        }
        const auto technique = variant.entry->make(variant.parameters);
        const auto frame = [&](int number) {
            stage_->redraw();
            stage_->render(*technique, scene_.timeline.still + number, seed_);
        };
        for (int i = 0; i < warmFrames; ++i) frame(i);
        count(variant, [&] { frame(warmFrames); });
    }

    /// A frame of the walk, without the choice of levels, which is the same for all techniques.
    void countWalkFrame(const techniques::Variant& variant) {
        if (!walk_) walk_.emplace(scene_, scene_.size);
        const auto technique = variant.entry->makeLod(variant.parameters);
        for (int i = 0; i < warmFrames; ++i) {
            walk_->show(std::min(i, scene_.lod->frames - 1));
            walk_->render(*technique);
        }
        walk_->show(std::min(warmFrames, scene_.lod->frames - 1));
        count(variant, [&] { walk_->render(*technique); });
    }

    const Scene& scene_;
    std::uint32_t seed_;
    std::optional<Stage> stage_;
    std::optional<lod::LodStage> walk_;
};

} // namespace

void renderCountedFrames(const CountJob& job) {
    const Scene scene = loadScene(job.scene, job.profile);
    for (const std::string& name : job.variants) {
        try {
            // A rasteriser of its own, so that the count does not depend on which techniques came before.
            const auto context = gl::Context::create();
            CountedScene(scene, job.seed).countFrame(techniques::parseVariant(name));
        } catch (const Error& error) {
            fmt::print(stderr, "{}: {}\n", name, error.what());
            continue;
        }
        fmt::print("counted {}\n", name);
        std::fflush(stdout);
    }
}

} // namespace shadowbench::timing
