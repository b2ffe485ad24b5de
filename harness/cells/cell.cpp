#include "harness/cells/cell.h"

#include "base/error.h"
#include "base/hash.h"
#include "groundtruth/area_comparison.h"
#include "harness/cells/environment.h"
#include "harness/measure/frame_cost.h"
#include "harness/metrics/frames.h"
#include "harness/metrics/pixels.h"
#include "techniques/contract/applicability.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>

namespace shadowbench {
namespace {

using groundtruth::Reference;
using metrics::Mask;
using techniques::Answer;

ReferenceInfo describe(const Reference& reference, const std::string& content) {
    double sum = 0;
    std::size_t penumbra = 0;
    for (std::size_t i = 0; i < reference.sigma.size(); ++i) {
        const float v = reference.visibility[i];
        if (reference.surface[i] != groundtruth::Surface::Receiver || v <= 0 || v >= 1) continue;
        sum += static_cast<double>(reference.sigma[i]) * static_cast<double>(reference.sigma[i]);
        ++penumbra;
    }
    const auto& provenance = reference.provenance;
    return {provenance.oracle,  provenance.key,
            provenance.samples, penumbra > 0 ? std::sqrt(sum / static_cast<double>(penumbra)) : 0,
            provenance.tools,   content};
}

/// How far the shown frame's soft truth, and the technique's `v`, are from the exact visible fraction.
AreaInfo besideArea(SceneFrames& frames, const Image<float>& v) {
    const Reference& exact = frames.truth(Truth::Area);
    const double rms = groundtruth::penumbraError(frames.truth(Truth::Soft), exact).rms;
    return {exact.provenance.key, frames.truths().content(Truth::Area, frames.scored()), rms,
            metrics::rmse({v, exact, frames.mask(Truth::Area)}).value_or(0)};
}

/// The receivers of what is shown. Throws InternalError where rasteriser and truth see other surfaces.
const Mask& alignedMask(SceneFrames& frames, Truth truth, int frame) {
    const Mask& mask = frames.mask(truth);
    if (mask.aligned) return mask;
    throw InternalError(
        fmt::format("the rasteriser and the ground truth disagree on the primary hit of {:.2f} % of the pixels of frame {} "
                    "(limit 0.10 %): camera or geometry differ, so no score is given",
                    100 * mask.primaryMismatch, frame));
}

/// Metrics of one frame against one truth, of those kinds that fit it.
template <class Kind>
void score(const metrics::ScoredFrame& frame, Record& record) {
    metrics::compute<Kind>(frame, record.values);
    std::optional<double>& worst = record.values["accuracy.primary_mismatch"];
    worst = std::max(worst.value_or(0), frame.mask.primaryMismatch);
}

/// The last still frame, which is shown, against every truth it is scored by (docs/metrics.md, "Which truth a cell is scored
/// against").
void scoreStillFrame(SceneFrames& frames, const techniques::Variant& variant, const Image<float>& v, Record& record) {
    const Scene& scene = frames.scene();
    const int frame = frames.scored();
    const auto described = [&](Truth truth) { return describe(frames.truth(truth), frames.truths().content(truth, frame)); };
    const auto scoreSoft = [&](std::optional<ReferenceInfo>& reference) {
        reference = described(Truth::Soft);
        if (scene.light.isArea()) reference->area = besideArea(frames, v);
        score<metrics::OfVisibility>({v, frames.truth(Truth::Soft), alignedMask(frames, Truth::Soft, frame)}, record);
    };
    if (mainTruth(scene, variant) == Truth::Soft) return scoreSoft(record.reference);
    const metrics::ScoredFrame labels{v, frames.truth(Truth::Hard), alignedMask(frames, Truth::Hard, frame)};
    record.reference = described(Truth::Hard);
    score<metrics::OfLabels>(labels, record);
    if (scene.light.isArea())
        scoreSoft(record.softReference);
    else if (variant.entry->answer == Answer::Filtered || variant.entry->temporal)
        score<metrics::OfVisibility>(labels, record);
    if (!usesPixelAreas(scene, variant)) return;
    record.pixelReference = described(Truth::PixelArea);
    if (!scene.light.isArea())
        score<metrics::OfPixelAreas>({v, frames.truth(Truth::PixelArea), frames.mask(Truth::PixelArea)}, record);
}

/// The still frames from an empty history. Labels are compared with the technique's own truth, graded visibility with the
/// truth that `accuracy.rmse` of the record is about.
class StillFrameScores {
public:
    StillFrameScores(const Reference& own, const Reference& graded, bool hard) : own_(own), graded_(graded), hard_(hard) {}

    void add(const Image<float>& v, const Mask& mask, const Mask& gradedMask, metrics::Values& values) {
        const metrics::ScoredFrame frame{v, own_, mask};
        if (hard_) metrics::appendFrame<metrics::LabelsByFrame>(frame, values);
        metrics::appendFrame<metrics::VisibilityByFrame>({v, graded_, gradedMask}, values);
        errors_.push_back(metrics::rmse(frame).value());
        pictures_.push_back(metrics::inBytes(v));
    }

    void finish(const Mask& mask, metrics::Values& values) const {
        const metrics::StillFrames frames{pictures_, errors_, mask};
        metrics::compute<metrics::OfStillFrames>(frames, values);
        metrics::computeLists(frames, values);
    }

private:
    const Reference& own_;
    const Reference& graded_;
    bool hard_;
    std::vector<double> errors_;
    std::vector<Image<std::uint8_t>> pictures_;
};

/// The frames that are scored one after the other, the last still one and the moving ones, against one truth.
class MovingFrameScores {
public:
    /// `remembers`: the technique has a history.
    MovingFrameScores(Truth truth, bool remembers) : truth_(truth) { frames_.remembers = remembers; }

    /// Adds what is shown, of which `v` is the technique's answer.
    void add(SceneFrames& frames, const Image<float>& v) {
        const Kept& now = kept_.emplace_back(Kept{v, frames.truth(truth_), frames.mask(truth_)});
        if (kept_.size() == 1) return;
        const Kept& before = kept_[kept_.size() - 2];
        frames_.pairs.push_back({{now.v, now.truth, now.mask}, {before.v, before.truth, before.mask}, frames.warp(truth_)});
    }

    template <class Kind>
    void finish(metrics::Values& values) const {
        metrics::compute<Kind>(frames_, values);
    }

    void keep(CellImages& images) const {
        if (frames_.pairs.empty()) return;
        for (const Kept& frame : kept_) images.sequence.push_back(frame.v);
        images.flicker.emplace_back(kept_.front().v.width(), kept_.front().v.height());
        for (const metrics::FramePair& pair : frames_.pairs) images.flicker.push_back(metrics::flickerMap(pair));
    }

private:
    struct Kept {
        Image<float> v;
        const Reference& truth;
        const Mask& mask;
    };
    Truth truth_;
    std::deque<Kept> kept_; // the pairs refer to its elements
    metrics::MovingFrames frames_;
};

/// What visibility is graded against, whatever the technique's own truth.
Truth gradedTruth(const Scene& scene) { return hasTruth(scene.light, Truth::Soft) ? Truth::Soft : Truth::Hard; }

/// Renders the last still frame from an empty history. Returns the number of frames that the technique has rendered.
int renderScored(SceneFrames& frames, const techniques::Variant& variant, techniques::Technique& technique,
                 std::uint32_t seed) {
    int number = 0;
    const int first = -frames.scene().timeline.approach;
    for (int frame = variant.entry->temporal ? first : frames.scored(); frame <= frames.scored(); ++frame) {
        if (frame <= 1 || frame == frames.scored()) frames.show(frame); // the still frames between are all the same
        frames.stage().render(technique, frame - first, seed);
        number = frame - first + 1;
    }
    return number;
}

/// Throws InternalError for a receiver pixel without an answer.
void requireAnswers(const Image<float>& v, const Mask& mask, const std::string& variant, int frame) {
    constexpr float rounding = 0x1p-10F; // of 1 in a 16-bit float
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (mask.scored[i] == 0 || (v[i] >= -rounding && v[i] <= 1 + rounding)) continue;
        const auto width = static_cast<std::size_t>(v.width());
        throw InternalError(fmt::format("{} wrote a visibility of {} at pixel ({}, {}) of frame {}; it must be in [0, 1]",
                                        variant, v[i], i % width, i / width, frame));
    }
}

void measureAliasing(const techniques::Technique& technique, SceneFrames& frames, const Mask& mask, Record& record) {
    const metrics::MapPoint mapPoint = [&](const glm::dvec3& world) { return technique.mapPoint(world); };
    const metrics::MappedFrame frame{frames.stage().shown().camera, frames.drawn().position, frames.stage().normals(), mask,
                                     mapPoint};
    metrics::compute<metrics::OfMap>(frame, record.values);
}

} // namespace

Record blankRecord(const Scene& scene, const techniques::Variant& variant, std::uint32_t seed) {
    Record record;
    record.scene = scene.id;
    record.technique = variant.entry->id;
    record.variant = variant.name;
    record.parameters = variant.parameters.all();
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
    record.environment = environmentOf(gl::Context::current().info());
    if (!variant.isLod()) record.tolerances = scene.tolerance; // they are about shadows
    return record;
}

Truth mainTruth(const Scene& scene, const techniques::Variant& variant) {
    const bool soft = variant.entry->answer == Answer::Soft || !hasTruth(scene.light, Truth::Hard);
    return soft ? Truth::Soft : Truth::Hard;
}

bool usesPixelAreas(const Scene& scene, const techniques::Variant& variant) {
    if (mainTruth(scene, variant) == Truth::Soft) return false;
    return scene.timeline.moving > 0 || !scene.light.isArea();
}

Truth sequenceTruth(const Scene& scene, const techniques::Variant& variant) {
    return usesPixelAreas(scene, variant) ? Truth::PixelArea : mainTruth(scene, variant);
}

std::string cellId(const Truths& truths, const Scene& scene, const techniques::Variant& variant, std::uint32_t seed,
                   int seeds) {
    std::string inputs = fmt::format("schema 2\n{}\n{}\nseed {}\nframes {}+{}\n", scene.id, variant.name, seed,
                                     scene.timeline.still, scene.timeline.moving);
    if (scene.timeline.approach > 0) inputs += fmt::format("approach {}\n", scene.timeline.approach);
    if (seeds > 1) inputs += fmt::format("seeds {}\n", seeds);
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

void scoreCell(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record,
               CellImages& images) {
    const Scene& scene = frames.scene();
    Stage& stage = frames.stage();
    const Truth kind = mainTruth(scene, variant);
    const int scored = frames.scored();
    const bool temporal = variant.entry->temporal;
    // The scene's own buffers, made for the first cell, are not the technique's.
    frames.show(temporal ? -scene.timeline.approach : scored);
    const std::uint64_t bytesBefore = gl::Context::current().tally().bytes;
    const auto technique = variant.entry->make(variant.parameters);

    const Truth graded = gradedTruth(scene);
    StillFrameScores still(frames.truths().at(kind, scored), frames.truths().at(graded, scored), kind == Truth::Hard);
    MovingFrameScores moving(kind, temporal);
    MovingFrameScores movingAreas(sequenceTruth(scene, variant), temporal);
    Hasher128 shown;
    std::uint64_t bytes = 0;
    const int first = -scene.timeline.approach;
    for (int frame = temporal ? first : scored; frame < scene.timeline.frames(); ++frame) {
        if (frame <= 1 || frame >= scored) frames.show(frame); // the still frames between are all the same
        stage.render(*technique, frame - first, seed);
        if (frame < 0) continue;
        const Image<float> v = stage.visibility();
        shown.add(v.data(), v.size() * sizeof(float));
        const Mask& mask = alignedMask(frames, kind, frame);
        requireAnswers(v, mask, variant.name, frame);
        if (temporal && frame <= scored) still.add(v, mask, frames.mask(graded), record.values);
        if (frame < scored) continue;
        if (frame == scored) {
            if (temporal) still.finish(mask, record.values);
            scoreStillFrame(frames, variant, v, record);
            record.figures =
                techniques::declaredFigures(*variant.entry, technique->figures(stage.frame(frame - first, seed)));
            measureAliasing(*technique, frames, mask, record);
            images.visibility = v;
            images.reference = &frames.truth(graded);
            bytes = gl::Context::current().tally().bytes - bytesBefore;
        }
        movingAreas.add(frames, v);
        moving.add(frames, v);
    }
    moving.finish<metrics::OfMovingFrames>(record.values);
    movingAreas.finish<metrics::OfMovingAreas>(record.values);
    if (images.wantsSequence) movingAreas.keep(images);
    record.images = shown.digest().text();

    frames.show(scored);
    const int next = scene.timeline.frames() - first; // of the technique's sequence
    timing::Sequence sequence{*technique, next, seed};
    timing::settle(stage, sequence);
    timing::measureWork(stage, sequence, bytes, record);
    record.status = Status::Scored;
}

void splitErrorOverSeeds(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, int seeds,
                         const Image<float>& v, Record& record) {
    std::vector<Image<float>> images{v};
    for (int i = 1; i < seeds; ++i) {
        const auto technique = variant.entry->make(variant.parameters);
        renderScored(frames, variant, *technique, seed + static_cast<std::uint32_t>(i));
        images.push_back(frames.stage().visibility());
        if (i == 1 && std::ranges::equal(images[0], images[1])) return;
    }
    const Truth graded = gradedTruth(frames.scene());
    metrics::compute<metrics::OfSeeds>(metrics::SeedFrames{images, frames.truth(graded), frames.mask(graded)},
                                       record.values);
}

void timeCell(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record) {
    const auto technique = variant.entry->make(variant.parameters);
    timing::Sequence sequence{*technique, renderScored(frames, variant, *technique, seed), seed};
    timing::settle(frames.stage(), sequence);
    timing::measureTimes(frames.stage(), variant, sequence, record);
}

} // namespace shadowbench
