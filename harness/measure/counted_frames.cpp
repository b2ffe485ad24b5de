// The half of instruction counting that runs under Callgrind.
#include "base/error.h"
#include "harness/measure/callgrind.h"
#include "harness/measure/warm_frames.h"
#include "harness/render/lod_stage.h"
#include "harness/render/stage.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>
#include <valgrind/callgrind.h>

namespace shadowbench::timing {
namespace {

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

    /// Draws without shadows and counts nothing: Valgrind translates the rasteriser's and its compiler's code, which takes
    /// longer than a short frame.
    void warmUp() {
        const techniques::Variant none = techniques::parseVariant("none");
        drawWarmFrames(*none.entry->make(none.parameters));
    }

    void countFrame(const techniques::Variant& variant) {
        if (variant.isLod())
            countWalkFrame(variant);
        else
            countShadowFrame(variant);
    }

private:
    void countShadowFrame(const techniques::Variant& variant) {
        const auto technique = variant.entry->make(variant.parameters);
        drawWarmFrames(*technique);
        count(variant, [&] { draw(*technique, warmFrames); });
    }

    void drawWarmFrames(techniques::Technique& technique) {
        if (!stage_) {
            stage_.emplace(scene_);
            stage_->show(scene_.timeline.still - 1);
        }
        for (int i = 0; i < warmFrames; ++i) draw(technique, i);
    }

    void draw(techniques::Technique& technique, int number) {
        stage_->redraw();
        stage_->render(technique, scene_.timeline.still + number, seed_);
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

/// Counts one variant and says so. In a process of its own, forked from one that has always done the same: what is counted
/// before it in the same run cannot move the count. The rasteriser starts no thread that the fork would lose.
void countAlone(const Scene& scene, std::uint32_t seed, const std::string& name) {
    try {
        const auto context = gl::Context::create();
        CountedScene(scene, seed).countFrame(techniques::parseVariant(name));
        fmt::print("counted {}\n", name);
    } catch (const Error& error) {
        fmt::print(stderr, "{}: {}\n", name, error.what());
    }
    std::fflush(stdout);
}

} // namespace

void requireCountable(const gl::ContextInfo& context) {
    if (!context.software)
        throw Inconclusive("instructions are counted of a rasteriser in software, not of " + context.renderer +
                           "; leave instructions out of --cost, or draw with --gl osmesa");
}

void renderCountedFrames(const CountJob& job, const std::filesystem::path& variants) {
    const Scene scene = loadScene(job.scene, job.profile);
    {
        const auto context = gl::Context::create();
        requireCountable(context->info());
        CountedScene(scene, job.seed).warmUp();
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> list(std::fopen(variants.c_str(), "r"), std::fclose);
    if (!list) throw BadInput(fmt::format("reading {} failed: {}", variants.string(), std::strerror(errno)));
    // Nothing on the heap grows with the list: what a child finds there is the same whatever else is counted.
    std::array<char, 1024> line{};
    while (std::fgets(line.data(), line.size(), list.get()) != nullptr) {
        line[std::strcspn(line.data(), "\n")] = '\0';
        const pid_t child = fork();
        if (child < 0) throw Inconclusive(std::string("counting needs another process: ") + std::strerror(errno));
        if (child == 0) {
            countAlone(scene, job.seed, line.data());
            _exit(0); // without what the parent would do at its end
        }
        waitpid(child, nullptr, 0); // one that crashed has left no count
    }
}

} // namespace shadowbench::timing
