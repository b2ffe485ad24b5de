// What techniques cost pass by pass beside the least that they need (docs/metrics.md, "Bare passes"), more steadily than a
// run's records on a busy machine: processor time of a rasteriser that draws on the calling thread, the fastest of many
// frames that alternate with the bare ones. Prints a line a pass, and a line a technique with its ratios.
//
//   build/release/benchmarks/bare_costs [--scene dueling-frusta] [--size 0] [--rounds 15] [--passes] VARIANT...
#include "base/error.h"
#include "harness/measure/frame_passes.h"
#include "harness/measure/warm_frames.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "techniques/gl/context.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace shadowbench::timing {
namespace {

struct Options {
    std::string scene = "dueling-frusta";
    std::vector<std::string> variants;
    int size = 0; // pixels per side; 0: the scene's own
    int rounds = 15;
    bool passes = false;
};

/// The least time of each pass over the rounds.
void keepLeast(FramePasses& least, const FramePasses& round) {
    for (PassCost& pass : least.passes) {
        const auto found = std::ranges::find(round.passes, pass.name, &PassCost::name);
        if (found != round.passes.end() && found->milliseconds > 0)
            pass.milliseconds = std::min(pass.milliseconds, found->milliseconds);
    }
    least.outside.milliseconds = std::min(least.outside.milliseconds, round.outside.milliseconds);
}

void setTimes(FramePasses& passes, double milliseconds) {
    for (PassCost& pass : passes.passes) pass.milliseconds = milliseconds;
    passes.outside.milliseconds = milliseconds;
}

ComparedPasses leastTimes(Stage& stage, Sequence& frames, int rounds) {
    ComparedPasses counted = countPasses(stage, frames);
    FramePasses own = counted.own, bare = counted.bare;
    setTimes(counted.own, std::numeric_limits<double>::infinity());
    setTimes(counted.bare, std::numeric_limits<double>::infinity());
    for (int round = 0; round < rounds; ++round) {
        timePasses(
            own,
            [&](techniques::PassListener& listener) {
                stage.redraw(&listener);
                stage.render(frames.technique, frames.index++, frames.seed, &listener);
            },
            1);
        keepLeast(counted.own, own);
        if (counted.declared.empty()) continue;
        timePasses(
            bare,
            [&](techniques::PassListener& listener) {
                stage.redraw(&listener);
                stage.renderBare(counted.declared, &listener);
            },
            1);
        keepLeast(counted.bare, bare);
    }
    return counted;
}

void printPasses(const ComparedPasses& costs) {
    for (const PassCost& pass : costs.own.passes) {
        const auto bare = std::ranges::find(costs.bare.passes, pass.name, &PassCost::name);
        const double least = bare == costs.bare.passes.end() ? 0 : bare->milliseconds;
        fmt::print("    {:24} {:3} {:9.3f} {:9.3f} {:6.2f}\n", pass.name, pass.runs, pass.milliseconds, least,
                   least > 0 ? pass.milliseconds / least : 0);
    }
    fmt::print("    {:24}     {:9.3f}\n", "between passes", costs.own.outside.milliseconds);
}

/// The frame's time, and its ratios to `uniform` milliseconds and to the bare passes'.
double print(const std::string& name, const ComparedPasses& costs, double uniform, bool passes) {
    const double own = costs.own.frame().milliseconds;
    fmt::print("{:40} {:9.3f} ms", name, own);
    if (uniform > 0) fmt::print("  x sm-uniform {:6.2f}", own / uniform);
    if (!costs.declared.empty()) {
        const double bare = costs.bare.frame().milliseconds, onDevice = own * (1 - costs.own.processorShare());
        fmt::print("  x bare {:5.2f}", onDevice / bare);
        if (uniform > 0) fmt::print("  bare x sm-uniform {:6.2f}", bare / uniform);
    }
    fmt::print("\n");
    if (passes) printPasses(costs);
    std::fflush(stdout);
    return own;
}

void measure(const Options& options) {
    Scene scene = loadScene(options.scene, Profile::Gate);
    if (options.size > 0) scene.size = glm::ivec2(options.size);
    const auto context = gl::Context::create();
    Stage stage(scene);
    stage.show(scene.timeline.still - 1);
    double uniform = 0;
    std::vector<std::string> variants = options.variants;
    variants.insert(variants.begin(), "sm-uniform");
    for (const std::string& name : variants) {
        const techniques::Variant variant = techniques::parseVariant(name);
        const auto technique = variant.entry->make(variant.parameters);
        Sequence frames{*technique, scene.timeline.still, 1};
        for (int i = 0; i < warmFrames; ++i) stage.render(*technique, frames.index++, frames.seed);
        const double own = print(name, leastTimes(stage, frames, options.rounds), uniform, options.passes);
        if (uniform == 0) uniform = own;
    }
}

} // namespace
} // namespace shadowbench::timing

int main(int argc, char** argv) {
    shadowbench::timing::Options options;
    CLI::App app{"What techniques cost beside the least that they need"};
    app.add_option("--scene", options.scene);
    app.add_option("--size", options.size);
    app.add_option("--rounds", options.rounds);
    app.add_flag("--passes", options.passes);
    app.add_option("variants", options.variants);
    CLI11_PARSE(app, argc, argv);
    try {
        shadowbench::timing::measure(options);
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
