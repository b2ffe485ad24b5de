#include "harness/cells/cell.h"

#include "base/error.h"
#include "base/hash.h"
#include "groundtruth/area_comparison.h"
#include "harness/cells/environment.h"
#include "harness/measure/frame_cost.h"
#include "harness/metrics/frames.h"
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

/// How far the frame's soft truth, and the technique's `v`, are from the exact visible fraction.
AreaInfo besideArea(Truths& truths, int frame, const Image<float>& v, const metrics::Drawn& drawn, const glm::dvec3& eye) {
    const Reference& exact = truths.at(Truth::Area, frame);
    const Mask mask = metrics::receiverMask(exact, drawn, eye);
    const double rms = groundtruth::penumbraError(truths.at(Truth::Soft, frame), exact).rms;
    return {exact.provenance.key, truths.content(Truth::Area, frame), rms, metrics::rmse({v, exact, mask}).value_or(0)};
}

/// The receivers of what is shown. Throws InternalError where rasteriser and truth see other surfaces.
Mask alignedMask(const Reference& truth, const metrics::Drawn& drawn, const glm::dvec3& eye, int frame) {
    Mask mask = metrics::receiverMask(truth, drawn, eye);
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

/// The last still frame against every truth it is scored by (docs/metrics.md, "Which truth a cell is scored against").
void scoreStillFrame(const Scene& scene, Truths& truths, const techniques::Variant& variant, const Image<float>& v,
                     const metrics::Drawn& drawn, const glm::dvec3& eye, Record& record) {
    const int frame = scene.timeline.still - 1;
    const auto scoreSoft = [&](std::optional<ReferenceInfo>& reference) {
        const Reference& soft = truths.at(Truth::Soft, frame);
        reference = describe(soft, truths.content(Truth::Soft, frame));
        if (scene.light.isArea()) reference->area = besideArea(truths, frame, v, drawn, eye);
        score<metrics::OfVisibility>({v, soft, alignedMask(soft, drawn, eye, frame)}, record);
    };
    if (mainTruth(scene, variant) == Truth::Soft) return scoreSoft(record.reference);
    const Reference& hard = truths.at(Truth::Hard, frame);
    const Mask mask = alignedMask(hard, drawn, eye, frame);
    record.reference = describe(hard, truths.content(Truth::Hard, frame));
    score<metrics::OfLabels>({v, hard, mask}, record);
    if (scene.light.isArea())
        scoreSoft(record.softReference);
    else if (variant.entry->answer == Answer::Filtered || variant.entry->temporal)
        score<metrics::OfVisibility>({v, hard, mask}, record);
    if (!usesPixelAreas(scene, variant)) return;
    const Reference& areas = truths.at(Truth::PixelArea, frame);
    record.pixelReference = describe(areas, truths.content(Truth::PixelArea, frame));
    if (!scene.light.isArea()) score<metrics::OfPixelAreas>({v, areas, metrics::receiverMask(areas, drawn, eye)}, record);
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
    void add(const Snapshot& shown, const Reference& truth, const Image<float>& v, Mask mask) {
        const Kept& now = kept_.emplace_back(Kept{v, truth, std::move(mask)});
        if (kept_.size() == 1) return;
        const Kept& before = kept_[kept_.size() - 2];
        Image<glm::vec2> warp = metrics::warp(shown, {now.v.width(), now.v.height()}, truth, before.truth);
        frames_.pairs.push_back({{now.v, now.truth, now.mask}, {before.v, before.truth, before.mask}, std::move(warp)});
    }

    template <class Kind>
    void finish(metrics::Values& values) const {
        metrics::compute<Kind>(frames_, values);
    }

private:
    struct Kept {
        Image<float> v;
        const Reference& truth;
        Mask mask;
    };
    std::deque<Kept> kept_; // the pairs refer to its elements
    metrics::MovingFrames frames_;
};

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

void measureAliasing(const techniques::Technique& technique, const Stage& stage, const Mask& mask, Record& record) {
    const metrics::MapPoint mapPoint = [&](const glm::dvec3& world) { return technique.mapPoint(world); };
    const metrics::MappedFrame frame{stage.shown().camera, stage.drawn().position, stage.normals(), mask, mapPoint};
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
    if (!scene.tolerance.empty() && !variant.isLod()) { // it is about shadows
        record.toleranceMetric = scene.tolerance.begin()->first;
        record.tolerance = scene.tolerance.begin()->second;
    }
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

std::string cellId(const Truths& truths, const Scene& scene, const techniques::Variant& variant, std::uint32_t seed) {
    std::string inputs = fmt::format("schema 2\n{}\n{}\nseed {}\nframes {}+{}\n", scene.id, variant.name, seed,
                                     scene.timeline.still, scene.timeline.moving);
    if (scene.timeline.approach > 0) inputs += fmt::format("approach {}\n", scene.timeline.approach);
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

void runCell(const Scene& scene, Stage& stage, Truths& truths, const techniques::Variant& variant,
             const MeasureOptions& options, Record& record, CellImages& images) {
    const Truth kind = mainTruth(scene, variant);
    const int scored = scene.timeline.still - 1;
    const bool temporal = variant.entry->temporal;
    stage.show(temporal ? -scene.timeline.approach
                        : scored); // the scene's own buffers, made for the first cell, are not the technique's
    const std::uint64_t bytesBefore = gl::Context::current().tally().bytes;
    const auto technique = variant.entry->make(variant.parameters);

    const bool soft = hasTruth(scene.light, Truth::Soft);
    const Reference& graded = truths.at(soft ? Truth::Soft : Truth::Hard, scored);
    StillFrameScores still(truths.at(kind, scored), graded, kind == Truth::Hard);
    const bool usesAreas = usesPixelAreas(scene, variant);
    MovingFrameScores moving, movingAreas;
    Hasher128 shown;
    std::uint64_t bytes = 0;
    const int first = -scene.timeline.approach;
    for (int frame = temporal ? first : scored; frame < scene.timeline.frames(); ++frame) {
        if (frame <= 1 || frame >= scored) stage.show(frame); // the still frames between are all the same
        stage.render(*technique, frame - first, options.seed);
        if (frame < 0) continue;
        Image<float> v = stage.visibility();
        shown.add(v.data(), v.size() * sizeof(float));
        const Reference& truth = truths.at(kind, std::max(frame, scored));
        Mask mask = alignedMask(truth, stage.drawn(), stage.shown().camera.eye, frame);
        requireAnswers(v, mask, variant.name, frame);
        if (temporal && frame <= scored)
            still.add(v, mask, metrics::receiverMask(graded, stage.drawn(), stage.shown().camera.eye), record.values);
        if (frame < scored) continue;
        if (frame == scored) {
            if (temporal) still.finish(mask, record.values);
            scoreStillFrame(scene, truths, variant, v, stage.drawn(), stage.shown().camera.eye, record);
            record.figures =
                techniques::declaredFigures(*variant.entry, technique->figures(stage.frame(frame - first, options.seed)));
            measureAliasing(*technique, stage, mask, record);
            images = {v, soft ? &truths.at(Truth::Soft, frame) : &truth};
            bytes = gl::Context::current().tally().bytes - bytesBefore;
        }
        const Reference& areas = usesAreas ? truths.at(Truth::PixelArea, frame) : truth;
        movingAreas.add(stage.shown(), areas, v, metrics::receiverMask(areas, stage.drawn(), stage.shown().camera.eye));
        moving.add(stage.shown(), truth, v, std::move(mask));
    }
    moving.finish<metrics::OfMovingFrames>(record.values);
    movingAreas.finish<metrics::OfMovingAreas>(record.values);
    record.images = shown.digest().text();

    stage.show(scored);
    const int next = scene.timeline.frames() - first; // of the technique's sequence
    timing::measureCosts(stage, variant, {*technique, next, options.seed}, bytes, options.time, record);
    if (options.otherScreen) record.otherScreen = timing::measureOtherScreen(scene, variant, scored, options.seed);
    record.status = Status::Scored;
}

} // namespace shadowbench
