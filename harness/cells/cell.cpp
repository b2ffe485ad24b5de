#include "harness/cells/cell.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/limits.h"
#include "base/trace.h"
#include "harness/cells/environment.h"
#include "harness/cells/image_scores.h"
#include "harness/measure/changed_cost.h"
#include "harness/measure/frame_cost.h"
#include "harness/metrics/frames.h"
#include "techniques/contract/applicability.h"
#include "techniques/folder_passes.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

using metrics::Mask;
using techniques::Answer;

/// The first frame that the technique draws.
int firstFrame(const SceneFrames& frames, const techniques::Entry& entry) {
    return entry.temporal ? -frames.scene().timeline.approach : frames.scored();
}

void measureAliasing(const techniques::Technique& technique, SceneFrames& frames, const Mask& mask, Record& record) {
    const Span span("metrics", "aliasing");
    const metrics::MapPoint mapPoint = [&](const glm::dvec3& world) { return technique.mapPoint(world); };
    const metrics::MappedFrame frame{frames.stage().shown().camera, frames.drawn().position, frames.stage().normals(), mask,
                                     mapPoint};
    metrics::compute<metrics::OfMap>(frame, record.values);
}

std::unique_ptr<techniques::Technique> made(const techniques::Variant& variant) {
    const Span span("setup", "technique");
    return variant.entry->make(variant.parameters);
}

/// By what the variant's images are scored.
ScoringRule scoringRuleOf(const Scene& scene, const techniques::Variant& variant) {
    const bool temporal = variant.entry->temporal;
    return {.truth = mainTruth(scene, variant),
            .graded = variant.entry->answer == Answer::Filtered || temporal,
            .pixelAreas = usesPixelAreas(scene, variant),
            .remembers = temporal,
            .stillFrames = temporal};
}

} // namespace

Record blankRecord(const Scene& scene, std::uint32_t seed) {
    Record record;
    record.scene = scene.id;
    record.profile = name(scene.profile);
    record.width = scene.size.x;
    record.height = scene.size.y;
    record.frames = scene.timeline.frames();
    record.seed = seed;
    const Commit commit = builtFrom();
    record.commit = commit.hash;
    record.dirty = commit.dirty;
    record.program = programHash();
    record.metricCode = metricCodeHash();
    record.time = timeNow();
    return record;
}

Record blankRecord(const Scene& scene, const techniques::Variant& variant, std::uint32_t seed) {
    Record record = blankRecord(scene, seed);
    record.technique = variant.entry->id;
    record.variant = variant.name;
    record.parameters = variant.parameters.all();
    record.environment = environmentOf(gl::Context::current().info());
    if (!variant.isLod()) record.tolerances = scene.tolerance; // they are about shadows
    return record;
}

Truth mainTruth(const Scene& scene, const techniques::Variant& variant) {
    const bool soft = variant.entry->answer == Answer::Soft || !hasTruth(scene.light, Truth::Hard);
    return soft ? Truth::Soft : Truth::Hard;
}

bool usesPixelAreas(const Scene& scene, const techniques::Variant& variant) {
    return usesPixelAreas(scene, mainTruth(scene, variant));
}

Truth sequenceTruth(const Scene& scene, const techniques::Variant& variant) {
    return usesPixelAreas(scene, variant) ? Truth::PixelArea : mainTruth(scene, variant);
}

std::string cellId(const Truths& truths, const Scene& scene, const techniques::Variant& variant,
                   const MeasureOptions& options) {
    std::string inputs = fmt::format("schema 2\n{}\n{}\nseed {}\nframes {}+{}\n", scene.id, variant.name, options.seed,
                                     scene.timeline.still, scene.timeline.moving);
    if (!variant.entry->digest.empty()) inputs += fmt::format("technique {}\n", variant.entry->digest);
    if (scene.timeline.approach > 0) inputs += fmt::format("approach {}\n", scene.timeline.approach);
    if (options.seeds > 1) inputs += fmt::format("seeds {}\n", options.seeds);
    if (options.views > 1) inputs += fmt::format("views {}\n", options.views);
    if (options.neighbours) inputs += "neighbours\n";
    for (const int frame : truths.scoredFrames()) {
        inputs += truths.key(mainTruth(scene, variant), frame) + "\n";
        if (usesPixelAreas(scene, variant)) inputs += truths.key(Truth::PixelArea, frame) + "\n";
    }
    return hash128(inputs).text();
}

std::optional<std::string> notApplicable(const Scene& scene, const techniques::Variant& variant) {
    if (auto reason = techniques::lightWithoutAnswer(scene, *variant.entry)) return reason;
    if (variant.entry->notApplicable) return variant.entry->notApplicable(scene);
    return std::nullopt;
}

std::chrono::seconds longestFor(const Scene& scene, const techniques::Variant& variant) {
    if (variant.entry->digest.empty()) return std::chrono::seconds(0);
    const double size = std::max(1.0, scene.size.x * scene.size.y / (256.0 * 256.0));
    return std::chrono::seconds(
        static_cast<std::int64_t>(std::ceil(static_cast<double>(limitOf(Limit::CellSeconds)) * size)));
}

InternalError lostCell(const std::string& how) {
    const bool isKilled = how.ends_with(fmt::format("signal {}", SIGKILL)); // as by a system without memory
    const std::string remedy = how.ends_with("was ended")
                                   ? fmt::format(": shorten its shaders' loops, or raise {}", variableOf(Limit::CellSeconds))
                                   : "";
    return InternalError(fmt::format("the process that rendered it {}{}", how, remedy),
                         isKilled ? Failure::Transient : Failure::Lasting);
}

void scoreCell(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record,
               CellImages& images, CellWork work) {
    const Scene& scene = frames.scene();
    Stage& stage = frames.stage();
    const Truth kind = mainTruth(scene, variant);
    const int scored = frames.scored();
    // The scene's own buffers, made for the first cell, are not the technique's.
    frames.show(firstFrame(frames, *variant.entry));
    gl::Tally& tally = gl::Context::current().tally();
    const std::uint64_t bytesBefore = tally.bytes;
    const auto technique = made(variant);

    ImageScores scores(
        frames, scoringRuleOf(scene, variant), [&](Truth truth) -> const Mask& { return frames.mask(truth); }, variant.name);
    Memory memory;
    const Casters casters = castersUnder(*variant.entry, scene);
    const int first = -scene.timeline.approach;
    timing::Sequence sequence{*technique, firstFrame(frames, *variant.entry) - first, seed};
    for (int frame = firstFrame(frames, *variant.entry); frame < scene.timeline.frames(); ++frame) {
        if (frame <= 1 || frame >= scored) frames.show(frame); // the still frames between are all the same
        tally.watchPeak();
        if (memory.peak || work == CellWork::LeftOut)
            stage.render(*technique, sequence.index++, seed);
        else if (variant.entry->temporal)
            timing::measureFirstWork(stage, sequence, record);
        else
            timing::measureFirstAndMotionWork(stage, casters, sequence, record);
        memory.peak = std::max(memory.peak.value_or(0), tally.peak - bytesBefore);
        if (frame < 0) continue;
        Image<float> v = stage.visibility();
        scores.add(frame, v, record);
        if (frame < scored) continue;
        if (frame == scored) {
            record.figures =
                techniques::declaredFigures(*variant.entry, technique->figures(stage.frame(frame - first, seed)));
            measureAliasing(*technique, frames, frames.mask(kind), record);
            images.reference = &frames.truth(gradedTruth(scene));
            memory.bytes = tally.bytes - bytesBefore;
        }
        images.frames.emplace(frame, std::move(v));
    }
    scores.finish(record);
    if (images.wantsFlicker) images.flicker = scores.flickerMaps();

    frames.show(scored);
    record.status = Status::Scored;
    if (work == CellWork::LeftOut) return;
    if (scene.timeline.moving > 0) timing::settle(stage, sequence); // else the last frame showed the same
    timing::measureWork(stage, sequence, record);
    if (variant.entry->temporal) timing::measureMotionWork(stage, casters, sequence, record);
    timing::keepChangedPasses(record);
    const auto& hashes = techniques::drawnWith(variant.entry->id);
    for (PassRecord& pass : record.passes)
        if (const auto found = hashes.find(pass.name); found != hashes.end()) pass.drawnWith = found->second;
    setMemory(record, memory);
}

int renderScored(SceneFrames& frames, const techniques::Entry& entry, techniques::Technique& technique, std::uint32_t seed,
                 const std::vector<Batch>* casters) {
    int number = 0;
    const int first = -frames.scene().timeline.approach;
    for (int frame = firstFrame(frames, entry); frame <= frames.scored(); ++frame) {
        if (frame <= 1 || frame == frames.scored()) { // the still frames between are all the same
            frames.show(frame);
            if (casters != nullptr) frames.stage().cast(*casters);
        }
        frames.stage().render(technique, frame - first, seed);
        number = frame - first + 1;
    }
    return number;
}

std::optional<double> scoredError(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Truth truth) {
    const auto technique = made(variant);
    renderScored(frames, *variant.entry, *technique, seed);
    return errorBy(truth, {frames.stage().visibility(), frames.truth(truth), frames.mask(truth)});
}

void splitErrorOverSeeds(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, int seeds,
                         const Image<float>& v, Record& record) {
    std::vector<Image<float>> images{v};
    for (int i = 1; i < seeds; ++i) {
        const auto technique = made(variant);
        renderScored(frames, *variant.entry, *technique, seed + static_cast<std::uint32_t>(i));
        images.push_back(frames.stage().visibility());
        if (i == 1 && std::ranges::equal(images[0], images[1])) return;
    }
    const Truth graded = gradedTruth(frames.scene());
    const groundtruth::Reference& truth = frames.truth(graded);
    const Mask& mask = frames.mask(graded);
    metrics::compute<metrics::OfSeeds>(metrics::SeedFrames{images, truth, mask}, record.values);
    std::vector<double> errors;
    for (const Image<float>& image : images)
        if (const std::optional<double> error = errorBy(graded, {image, truth, mask})) errors.push_back(*error);
    if (errors.empty()) return;
    const auto [mean, half] = metrics::meanInterval(errors);
    record.values["stability.seeds.mean"] = mean;
    record.values["stability.seeds.interval"] = half;
    record.values.list("stability.seeds.errors") = std::move(errors);
}

void timeCell(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record) {
    const int first = firstFrame(frames, *variant.entry);
    frames.show(first);
    const Casters casters = castersUnder(*variant.entry, frames.scene());
    const int index = first + frames.scene().timeline.approach;
    Stage& stage = frames.stage();
    if (!variant.entry->temporal) stage.show(displaced(stage.shown(), casters)); // as where its work was counted
    const auto technique = timing::measureFirstTime(stage, variant, index, seed, record);
    if (variant.entry->temporal) technique->reset(); // its history is that of its own frames
    timing::Sequence sequence{*technique, renderScored(frames, *variant.entry, *technique, seed), seed};
    timing::measureTimes(stage, variant, sequence, record);
    timing::measureMotionTime(stage, casters, sequence, record);
}

} // namespace shadowbench
