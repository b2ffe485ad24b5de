#include "harness/measure/device_cost.h"

#include "harness/measure/frame_passes.h"
#include "harness/measure/rounds.h"
#include "harness/measure/statistics.h"
#include "harness/measure/warm_frames.h"
#include "harness/render/lod_stage.h"
#include "harness/render/motion.h"
#include "harness/render/stage.h"
#include "techniques/catalog.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <utility>

namespace shadowbench::timing {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int loadSide = 256;
constexpr double loadMilliseconds = 3; // longer than it takes to submit a frame
constexpr double clockIsUp = 1.1;      // the load takes at most so much longer than at its fastest

/// How often a frame is timed that takes so long.
struct FrameRounds {
    int whole, others; // its own; its passes, in motion, from cold
};

FrameRounds roundsOf(double milliseconds) {
    constexpr double budget = 250, longFrame = 100; // ms: so long a time varies little
    if (milliseconds > longFrame) return {1, 1};
    return {std::clamp(static_cast<int>(budget / (milliseconds + 2 * loadMilliseconds)), 3, 15), 3};
}

constexpr const char* loadShader = R"(
layout(location = 0) out float result;
uniform int turns;
void main() {
    vec4 v = gl_FragCoord.xyzw;
    for (int i = 0; i < turns; ++i) {
        v = v * 0.999 + 0.001;
        v = v * 0.998 + 0.002;
    }
    result = v.x + v.y + v.z + v.w;
}
)";

glm::ivec2 screenOf(const Scene& scene, int longer) {
    return glm::max(scene.size * longer / std::max(scene.size.x, scene.size.y), glm::ivec2(1));
}

/// A mark between passes keeps the next one waiting: not for the time of a whole frame.
class Unheard final : public techniques::PassListener {
    void begin(std::string_view /*pass*/) override {}
    void end(std::string_view /*pass*/) override {}
};

} // namespace

bool hasDeviceClock() { return !gl::Context::current().info().software && gl::TimeStamps::isSupported(); }

void setTimes(Record& record, const std::vector<DeviceTimes>& times) {
    const DeviceTimes& all = times.front();
    const DeviceCost& cost = all.cost;
    Time time;
    time.median = cost.median;
    time.p95 = percentile(all.samples, 0.95);
    time.mad = cost.mad;
    time.ratio = cost.ratio;
    time.floorRatio = cost.passes.front().milliseconds.value_or(0) / cost.median; // the G-buffer is the first
    time.processorShare = cost.processor / (cost.processor + cost.median);
    time.samples = all.samples;
    setTime(record, time);
    setTime(record, MotionTime{*cost.motion, all.motionRatio, all.motionSamples});
    setTime(record, ColdTime{*cost.first, all.compile});
    setLodTimes(record, times);
}

void setLodTimes(Record& record, const std::vector<DeviceTimes>& times) {
    record.deviceCosts.clear();
    for (const DeviceTimes& each : times) record.deviceCosts.push_back(each.cost);
}

/// Marks where passes begin and end, on the clocks of both processors.
class DeviceMeter::Stamped final : public techniques::PassListener {
public:
    void begin(std::string_view pass) override { mark(pass); }
    void end(std::string_view /*pass*/) override { mark(betweenPasses); }

    /// Milliseconds on the graphics processor of what began as `name`, all its runs together.
    [[nodiscard]] double of(std::string_view name) const { return sum(name, stamps_.intervals()); }

    /// Until the program went on: of what only submits, little.
    [[nodiscard]] double onProcessor(std::string_view name) const {
        std::vector<double> intervals;
        for (std::size_t i = 1; i < wall_.size(); ++i)
            intervals.push_back(std::chrono::duration<double, std::milli>(wall_[i] - wall_[i - 1]).count());
        return sum(name, intervals);
    }

private:
    void mark(std::string_view name) {
        names_.emplace_back(name);
        stamps_.mark();
        wall_.push_back(Clock::now());
    }

    [[nodiscard]] double sum(std::string_view name, const std::vector<double>& intervals) const {
        double result = 0;
        for (std::size_t i = 0; i < intervals.size(); ++i)
            if (names_[i] == name) result += intervals[i];
        return result;
    }

    gl::TimeStamps stamps_;
    std::vector<Clock::time_point> wall_;
    std::vector<std::string> names_;
};

DeviceMeter::DeviceMeter()
    : texture_(gl::Format::R32F, {loadSide, loadSide}), target_{&texture_},
      load_(gl::Program::screenFromText("load", loadShader)), isDevice_(hasDeviceClock()),
      fastest_(std::numeric_limits<double>::infinity()) {
    raiseClock();
    const double turns = turns_ * loadMilliseconds / fastest_;
    turns_ = std::max(1, static_cast<int>(turns));
    fastest_ = std::numeric_limits<double>::infinity();
    raiseClock();
}

/// Milliseconds of the load.
double DeviceMeter::busy() {
    gl::TimeStamps stamps;
    stamps.mark();
    target_.bind();
    load_.set("turns", turns_);
    load_.drawScreen();
    stamps.mark();
    const double time = stamps.intervals().front();
    fastest_ = std::min(fastest_, time);
    return time;
}

/// Until the load is as fast as it was, or no faster for a while: clocks rise within tenths of a second.
void DeviceMeter::raiseClock() {
    if (!isDevice_) {
        busy();
        return;
    }
    constexpr double longest = 1.5, least = 0.2; // s
    const bool isKnown = fastest_ < std::numeric_limits<double>::infinity();
    const auto start = Clock::now();
    while (secondsSince(start) < longest) {
        const double time = busy();
        if (time <= clockIsUp * fastest_ && (isKnown || secondsSince(start) > least)) break;
    }
}

std::vector<double> DeviceMeter::samples(int rounds, const std::function<void()>& before, const RenderFrame& render) {
    std::vector<double> times;
    for (int again = 0; static_cast<int>(times.size()) < rounds; ++again) {
        if (before) before();
        raiseClock();
        Stamped whole;
        whole.begin("load");
        target_.bind();
        load_.drawScreen();
        whole.begin("frame");
        Unheard unheard;
        render(unheard);
        whole.end("frame");
        const bool wasUp = !isDevice_ || whole.of("load") <= clockIsUp * fastest_;
        if (wasUp || again >= 2 * rounds) times.push_back(whole.of("frame"));
    }
    return times;
}

double DeviceMeter::timePasses(FramePasses& passes, const RenderFrame& render, int rounds) {
    std::vector<std::vector<double>> times(passes.passes.size());
    std::vector<double> between, processor;
    for (int round = 0; round < rounds; ++round) {
        raiseClock();
        target_.bind();
        load_.drawScreen();
        Stamped stamps;
        stamps.end(""); // what comes before the first pass lies between passes
        render(stamps);
        stamps.end("");
        for (std::size_t i = 0; i < times.size(); ++i) times[i].push_back(stamps.of(passes.passes[i].name));
        between.push_back(stamps.of(betweenPasses));
        double alone = 0;
        for (const PassCost& pass : passes.passes)
            if (pass.work.draws == 0 && pass.work.passes == 0) alone += stamps.onProcessor(pass.name);
        processor.push_back(alone);
    }
    for (std::size_t i = 0; i < times.size(); ++i) passes.passes[i].milliseconds = median(times[i]);
    passes.outside.milliseconds = median(between);
    return median(processor);
}

DeviceTimes DeviceMeter::measure(const MeasuredFrames& frames, int width, int height) {
    FramePasses passes = countPasses(frames.standing);
    const FrameRounds rounds = roundsOf(samples(1, {}, frames.standing).front());
    const auto base = [&](techniques::PassListener&) { frames.base(); };
    DeviceTimes times;
    DeviceCost& cost = times.cost;
    cost.width = width;
    cost.height = height;
    std::vector<double> others;
    for (int round = 0; round < rounds.whole; ++round) {
        times.samples.push_back(samples(1, {}, frames.standing).front());
        others.push_back(samples(1, {}, base).front());
    }
    cost.median = median(times.samples);
    cost.mad = medianDeviation(times.samples);
    cost.ratio = median(quotients(times.samples, others));
    cost.processor = timePasses(passes, frames.standing, rounds.others);
    cost.passes = passRecords(passes, true);
    if (frames.moved) {
        others.clear();
        for (int round = 0; round < rounds.others; ++round) {
            times.motionSamples.push_back(samples(1, frames.leave, frames.moved).front());
            others.push_back(samples(1, {}, base).front());
        }
        cost.motion = median(times.motionSamples);
        times.motionRatio = median(quotients(times.motionSamples, others));
        frames.stand();
    }
    if (frames.forget) cost.first = median(samples(rounds.others, frames.forget, frames.standing));
    return times;
}

std::vector<DeviceTimes> DeviceMeter::measure(const Scene& scene, const techniques::Variant& variant, int frame,
                                              std::uint32_t seed, const Screens& screens) {
    std::vector<DeviceTimes> times;
    for (const int longer : screens) {
        Scene large = scene;
        large.size = screenOf(scene, longer);
        Stage stage(large);
        stage.show(frame);
        const techniques::Variant uniform = techniques::parseVariant("sm-uniform");
        const auto base = uniform.entry->make(uniform.parameters);
        std::unique_ptr<techniques::Technique> technique;
        const double withCompiling = wallMilliseconds([&] {
            technique = variant.entry->make(variant.parameters);
            stage.render(*technique, 0, seed);
        });
        technique->reset();
        const double first = wallMilliseconds([&] { stage.render(*technique, 0, seed); });
        Sequence sequence{*technique, 1, seed};
        for (; sequence.index < warmFrames; ++sequence.index) {
            stage.render(*base, sequence.index, seed);
            stage.render(*technique, sequence.index, seed);
        }
        const Snapshot standing = stage.shown();
        const Casters casters = castersUnder(*variant.entry, scene);
        const Snapshot away = displaced(standing, casters), back = returned(standing, casters);
        const MeasuredFrames frames{
            .standing = framesOf(stage, sequence),
            .base =
                [&] {
                    stage.redraw();
                    stage.render(*base, sequence.index, seed);
                },
            .forget = [&] { technique->reset(); },
            .leave =
                [&] {
                    stage.show(away);
                    stage.render(*technique, sequence.index++, seed);
                    stage.show(back);
                },
            .stand = [&] { stage.show(standing); },
            .moved = framesOf(stage, sequence),
        };
        times.push_back(measure(frames, large.size.x, large.size.y));
        times.back().compile = std::max(withCompiling - first, 0.0);
    }
    return times;
}

std::vector<DeviceTimes> DeviceMeter::measureLod(const Scene& scene, const techniques::Variant& variant, int frame,
                                                 const Screens& screens) {
    std::vector<DeviceTimes> times;
    for (const int longer : screens) {
        const glm::ivec2 size = screenOf(scene, longer);
        lod::LodStage stage(scene, size);
        const techniques::Variant switching = techniques::parseVariant("lod-switch");
        const auto base = switching.entry->makeLod(switching.parameters),
                   technique = variant.entry->makeLod(variant.parameters);
        stage.show(frame);
        for (int i = 0; i < warmFrames; ++i) {
            stage.render(*base);
            stage.render(*technique);
        }
        const MeasuredFrames frames{
            .standing = [&](techniques::PassListener& listener) { stage.render(*technique, &listener); },
            .base = [&] { stage.render(*base); }};
        times.push_back(measure(frames, size.x, size.y));
    }
    return times;
}

} // namespace shadowbench::timing
