#include "harness/measure/pass_cost.h"

#include "base/error.h"
#include "base/trace.h"
#include "harness/measure/raster_clock.h"
#include "harness/measure/statistics.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace shadowbench::timing {
namespace {

void add(gl::WorkCount& sum, const gl::WorkCount& more) {
    sum.fragments += more.fragments;
    sum.vertices += more.vertices;
    sum.primitives += more.primitives;
    sum.draws += more.draws;
    sum.passes += more.passes;
}

void add(PassCost& sum, const PassCost& more) {
    sum.milliseconds += more.milliseconds;
    add(sum.work, more.work);
}

/// Cuts a frame where passes begin and end. What `Section` measures of each part, between construction and `finish`, is
/// added to the part's pass, or to what lies outside.
template <typename Section>
class FrameCutter final : public techniques::PassListener {
public:
    FrameCutter() {
        gl::Context::current().finish(); // what was submitted before
        section_.emplace();
    }

    void begin(std::string_view pass) override {
        if (inPass_) throw InternalError(fmt::format("the pass \"{}\" begins within another; passes do not nest", pass));
        endSection(result_.outside);
        inPass_ = true;
        ++costOf(pass).runs;
        section_.emplace();
    }

    void end(std::string_view pass) override {
        endSection(costOf(pass));
        inPass_ = false;
        section_.emplace();
    }

    FramePasses finish() {
        endSection(result_.outside);
        return std::move(result_);
    }

private:
    PassCost& costOf(std::string_view name) {
        const auto known = std::ranges::find(result_.passes, name, &PassCost::name);
        return known != result_.passes.end() ? *known : result_.passes.emplace_back(PassCost{std::string(name), 0, 0, {}});
    }

    void endSection(PassCost& cost) {
        section_->finish(cost);
        section_.reset();
    }

    FramePasses result_;
    std::optional<Section> section_;
    bool inPass_ = false;
};

class WorkSection {
public:
    void finish(PassCost& cost) { add(cost.work, meter_.finish()); }

private:
    gl::WorkMeter meter_;
};

class WallSection {
public:
    void finish(PassCost& cost) {
        gl::Context::current().finish();
        cost.milliseconds += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class TimeSection {
public:
    void finish(PassCost& cost) { cost.milliseconds += timer_.milliseconds(); }

private:
    PartTimer timer_;
};

template <typename Section>
FramePasses measured(const RenderFrame& render) {
    FrameCutter<Section> cutter;
    render(cutter);
    return cutter.finish();
}

double medianTime(const std::vector<FramePasses>& rounds, const std::string& pass) {
    std::vector<double> times;
    for (const FramePasses& round : rounds) {
        const auto found = std::ranges::find(round.passes, pass, &PassCost::name);
        if (found != round.passes.end()) times.push_back(found->milliseconds);
    }
    return times.empty() ? 0 : median(times);
}

} // namespace

PassCost FramePasses::frame() const {
    PassCost sum{"frame", 1, 0, {}};
    for (const PassCost& pass : passes) add(sum, pass);
    add(sum, outside);
    return sum;
}

double FramePasses::processorShare() const {
    double processor = outside.milliseconds;
    for (const PassCost& pass : passes)
        if (pass.work.draws == 0 && pass.work.passes == 0) processor += pass.milliseconds;
    const double all = frame().milliseconds;
    return all > 0 ? processor / all : 0;
}

FramePasses countPasses(const RenderFrame& render) {
    const Span span("frame", "counted");
    return measured<WorkSection>(render);
}

FramePasses timeOnce(const RenderFrame& render) { return measured<WallSection>(render); }

void timePasses(FramePasses& counted, const RenderFrame& render, int rounds, double budgetMilliseconds) {
    std::vector<FramePasses> timed;
    std::vector<double> outside;
    const double start = rasterMilliseconds();
    for (int round = 0; round < rounds; ++round) {
        if (round > 0 && rasterMilliseconds() - start > budgetMilliseconds) break;
        timed.push_back(measured<TimeSection>(render));
        outside.push_back(timed.back().outside.milliseconds);
    }
    for (PassCost& pass : counted.passes) pass.milliseconds = medianTime(timed, pass.name);
    counted.outside.milliseconds = median(outside);
}

FramePasses measurePasses(const RenderFrame& render, int rounds) {
    FramePasses result = countPasses(render);
    timePasses(result, render, rounds);
    return result;
}

FramePasses measurePasses(Stage& stage, techniques::Technique& technique, int index, std::uint32_t seed, int rounds) {
    return measurePasses(
        [&](techniques::PassListener& listener) {
            stage.redraw(&listener);
            stage.render(technique, index++, seed, &listener);
        },
        rounds);
}

FramePasses measurePasses(lod::LodStage& stage, techniques::LodTechnique& technique, int rounds) {
    return measurePasses([&](techniques::PassListener& listener) { stage.render(technique, &listener); }, rounds);
}

} // namespace shadowbench::timing
