// The half of instruction counting that runs under Callgrind.
#include "harness/run/stage.h"
#include "harness/scene/error.h"
#include "harness/timing/callgrind.h"
#include "techniques/gl/context.h"

#include <cstdio>
#include <fmt/format.h>
#include <valgrind/callgrind.h>

namespace shadowbench::timing {
namespace {

constexpr int warmFrames = 2; // the first compiles shaders, the second meets what the first left

void countFrame(Stage& stage, const techniques::Variant& variant, int index, std::uint32_t seed) {
    const auto technique = variant.entry->make(variant.parameters);
    const auto frame = [&](int number) {
        stage.redraw();
        stage.render(*technique, number, seed);
        gl::Context::current().finish();
    };
    for (int i = 0; i < warmFrames; ++i) frame(index + i);
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
    frame(index + warmFrames);
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_STOP_INSTRUMENTATION;
    CALLGRIND_DUMP_STATS_AT(variant.name.c_str());
}

} // namespace

void renderCountedFrames(const CountJob& job) {
    const Scene scene = loadScene(job.scene, job.profile);
    const auto context = gl::Context::create();
    Stage stage(scene);
    stage.show(scene.timeline.still - 1);
    for (const std::string& name : job.variants) {
        try {
            countFrame(stage, techniques::parseVariant(name), scene.timeline.still, job.seed);
        } catch (const Error& error) {
            fmt::print(stderr, "{}: {}\n", name, error.what());
            continue;
        }
        fmt::print("counted {}\n", name);
        std::fflush(stdout);
    }
}

} // namespace shadowbench::timing
