#include "harness/cells/cell.h"

#include "base/error.h"
#include "base/hash.h"
#include "harness/cells/environment.h"
#include "harness/measure/frame_cost.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench {
namespace {

using groundtruth::Reference;
using metrics::FrameResult;
using metrics::Mask;
using techniques::Answer;

constexpr double primaryLimit = 0.001; // docs/metrics.md, "Notation": above this a cell is an error, not a score

/// The truth that a technique's answer is measured by frame after frame.
Truth mainTruth(const techniques::Variant& variant) {
    return variant.entry->answer == Answer::Soft ? Truth::Soft : Truth::Hard;
}

ReferenceInfo describe(const Reference& reference) {
    double sum = 0;
    std::size_t penumbra = 0;
    for (std::size_t i = 0; i < reference.sigma.size(); ++i) {
        const float v = reference.visibility[i];
        if (reference.surface[i] != groundtruth::Surface::Receiver || v <= 0 || v >= 1) continue;
        sum += static_cast<double>(reference.sigma[i]) * static_cast<double>(reference.sigma[i]);
        ++penumbra;
    }
    const auto& provenance = reference.provenance;
    return {provenance.oracle, provenance.key, provenance.samples,
            penumbra > 0 ? std::sqrt(sum / static_cast<double>(penumbra)) : 0, provenance.tools};
}

/// Soft scores join the hard ones of the same cell.
void addSoftScores(Accuracy& accuracy, const Accuracy& soft) {
    Accuracy both = soft;
    both.mismatch = accuracy.mismatch;
    both.mismatchOffEdge = accuracy.mismatchOffEdge;
    both.falseShadow = accuracy.falseShadow;
    both.leak = accuracy.leak;
    both.edgeError = accuracy.edgeError;
    both.primaryMismatch = std::max(accuracy.primaryMismatch, soft.primaryMismatch);
    accuracy = both;
}

/// The last still frame against every truth it is scored by (docs/metrics.md, "Which truth a cell is scored against").
void scoreStillFrame(const Scene& scene, Truths& truths, const techniques::Variant& variant, const Image<float>& v,
                     const metrics::Drawn& drawn, const glm::dvec3& eye, Record& record) {
    const int frame = scene.timeline.still - 1;
    if (variant.entry->answer == Answer::Soft) {
        const Reference& soft = truths.at(Truth::Soft, frame);
        record.reference = describe(soft);
        record.accuracy = metrics::softAccuracy(v, soft, metrics::receiverMask(soft, drawn, eye));
        return;
    }
    const Reference& hard = truths.at(Truth::Hard, frame);
    const Mask mask = metrics::receiverMask(hard, drawn, eye);
    record.reference = describe(hard);
    record.accuracy = metrics::hardAccuracy(v, hard, mask);
    if (scene.light.isArea()) {
        const Reference& soft = truths.at(Truth::Soft, frame);
        record.softReference = describe(soft);
        addSoftScores(record.accuracy, metrics::softAccuracy(v, soft, metrics::receiverMask(soft, drawn, eye)));
    } else if (variant.entry->answer == Answer::Filtered || variant.entry->temporal) {
        addSoftScores(record.accuracy, metrics::softAccuracy(v, hard, mask));
    }
}

Image<std::uint8_t> toBytes(const Image<float>& v) {
    Image<std::uint8_t> bytes(v.width(), v.height());
    std::transform(v.begin(), v.end(), bytes.begin(),
                   [](float x) { return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(x, 0.0F, 1.0F))); });
    return bytes;
}

double shareChanged(const Image<std::uint8_t>& a, const Image<std::uint8_t>& b, const Mask& mask) {
    std::size_t changed = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (mask.scored[i] != 0 && std::abs(a[i] - b[i]) > 30) ++changed;
    return static_cast<double>(changed) / static_cast<double>(mask.count);
}

/// Error over the still frames from an empty history. Labels are compared with the technique's own truth, graded visibility
/// with the truth that `rmse` of the record is about.
class StillCurve {
public:
    StillCurve(const Reference& own, const Reference& graded, bool hard) : own_(own), graded_(graded), hard_(hard) {}

    void add(const Image<float>& v, const Mask& mask, const Mask& gradedMask, Stability& stability) {
        if (hard_) stability.mismatchByFrame.push_back(metrics::mismatch(v, own_, mask));
        stability.rmseByFrame.push_back(metrics::rmse(v, graded_, gradedMask));
        stability.bad30ByFrame.push_back(metrics::shareAbove(v, graded_.visibility, gradedMask, 30.0 / 255));
        ownError_.push_back(metrics::rmse(v, own_, mask));
        frames_.push_back(toBytes(v));
    }

    void finish(const Mask& mask, Stability& stability) const {
        for (const Image<std::uint8_t>& frame : frames_)
            stability.changedByFrame.push_back(shareChanged(frame, frames_.back(), mask));
        stability.convergence = metrics::convergence(ownError_);
    }

private:
    const Reference& own_;
    const Reference& graded_;
    bool hard_;
    std::vector<double> ownError_;
    std::vector<Image<std::uint8_t>> frames_;
};

/// Flicker and flips from one scored frame to the next, and the error of all after the first.
class MotionScores {
public:
    void add(const Snapshot& shown, const Reference& truth, Image<float> v, Mask mask) {
        if (before_.truth != nullptr) {
            const Image<glm::vec2> warp = metrics::warp(shown, {v.width(), v.height()}, truth, *before_.truth);
            const FrameResult now{&v, &truth, &mask}, before{&before_.v, before_.truth, &before_.mask};
            metrics::flickerSamples(now, before, warp, samples_);
            metrics::addMovingError(now, warp, error_);
            const metrics::Flips flips = metrics::flips(now, before, warp);
            flips_.flipped += flips.flipped;
            flips_.compared += flips.compared;
            for (std::size_t i = 0; i < warp.size(); ++i) {
                if (truth.surface[i] == groundtruth::Surface::Background) continue;
                ++surfacePixels_;
                if (!std::isnan(warp[i].x)) ++seenBefore_;
            }
        }
        before_ = {std::move(v), &truth, std::move(mask)};
    }

    void finish(Stability& stability) {
        stability.flicker = metrics::flicker(std::move(samples_));
        if (flips_.compared > 0)
            stability.flipRate = static_cast<double>(flips_.flipped) / static_cast<double>(flips_.compared);
        stability.movingRmse = error_.all.root();
        stability.disocclusionError = error_.disoccluded.root();
        if (surfacePixels_ > 0) stability.reuse = static_cast<double>(seenBefore_) / static_cast<double>(surfacePixels_);
    }

private:
    struct Kept {
        Image<float> v;
        const Reference* truth = nullptr;
        Mask mask;
    };
    Kept before_;
    std::vector<float> samples_;
    metrics::Flips flips_;
    metrics::MovingError error_;
    std::size_t surfacePixels_ = 0, seenBefore_ = 0;
};

std::optional<Aliasing> aliasingOf(const techniques::Technique& technique, const Stage& stage, const Mask& mask) {
    return metrics::aliasing(stage.shown().camera, stage.drawn().position, stage.normals(), mask,
                             [&](const glm::dvec3& world) { return technique.mapPoint(world); });
}

void requireSamePrimaryHits(double share, const Scene& scene, int frame) {
    if (share <= primaryLimit) return;
    throw InternalError(
        fmt::format("frame {} of scene {}: the rasteriser and the ground truth disagree on the primary hit of {:.2f} % of "
                    "the pixels (limit 0.10 %): camera or geometry differ, so no score is given",
                    frame, scene.id, 100 * share));
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
    record.time = timeNow();
    record.environment = environmentOf(gl::Context::current().info());
    if (!scene.tolerance.empty() && !variant.isLod()) { // it is about shadows
        record.toleranceMetric = scene.tolerance.begin()->first;
        record.tolerance = scene.tolerance.begin()->second;
    }
    return record;
}

std::string cellId(const Truths& truths, const Scene& scene, const techniques::Variant& variant, std::uint32_t seed) {
    std::string inputs = fmt::format("schema 2\n{}\n{}\nseed {}\nframes {}+{}\n", scene.id, variant.name, seed,
                                     scene.timeline.still, scene.timeline.moving);
    for (const int frame : truths.scoredFrames()) inputs += truths.key(mainTruth(variant), frame) + "\n";
    return hash128(inputs).text();
}

std::optional<std::string> notApplicable(const Scene& scene, const techniques::Variant& variant) {
    if (variant.entry->answer == Answer::Soft && !scene.light.isArea())
        return fmt::format("needs an area light; the light of {} is {}", scene.id,
                           scene.light.kind == LightKind::Point ? "a point" : "directional");
    if (variant.entry->notApplicable) return variant.entry->notApplicable(scene);
    return std::nullopt;
}

void runCell(const Scene& scene, Stage& stage, Truths& truths, const techniques::Variant& variant,
             const MeasureOptions& options, Record& record, CellImages& images) {
    const Truth kind = mainTruth(variant);
    const int scored = scene.timeline.still - 1;
    const bool temporal = variant.entry->temporal;
    stage.show(temporal ? 0 : scored); // the scene's own buffers, made for the first cell, are not the technique's
    const std::uint64_t bytesBefore = gl::Context::current().tally().bytes;
    const auto technique = variant.entry->make(variant.parameters);

    const Reference& graded = truths.at(scene.light.isArea() ? Truth::Soft : Truth::Hard, scored);
    StillCurve curve(truths.at(kind, scored), graded, kind == Truth::Hard);
    MotionScores motion;
    std::uint64_t bytes = 0;
    for (int frame = temporal ? 0 : scored; frame < scene.timeline.frames(); ++frame) {
        if (frame == 0 || frame >= scored) stage.show(frame); // the still frames between are all the same
        stage.render(*technique, frame, options.seed);
        Image<float> v = stage.visibility();
        const Reference& truth = truths.at(kind, std::max(frame, scored));
        Mask mask = metrics::receiverMask(truth, stage.drawn(), stage.shown().camera.eye);
        requireSamePrimaryHits(mask.primaryMismatch, scene, frame);
        if (temporal && frame <= scored)
            curve.add(v, mask, metrics::receiverMask(graded, stage.drawn(), stage.shown().camera.eye), record.stability);
        if (frame < scored) continue;
        if (frame == scored) {
            if (temporal) curve.finish(mask, record.stability);
            scoreStillFrame(scene, truths, variant, v, stage.drawn(), stage.shown().camera.eye, record);
            requireSamePrimaryHits(record.accuracy.primaryMismatch, scene, frame);
            record.figures =
                techniques::declaredFigures(*variant.entry, technique->figures(stage.frame(frame, options.seed)));
            record.aliasing = aliasingOf(*technique, stage, mask);
            images = {v, scene.light.isArea() ? &truths.at(Truth::Soft, frame) : &truth};
            bytes = gl::Context::current().tally().bytes - bytesBefore;
        }
        motion.add(stage.shown(), truth, std::move(v), std::move(mask));
    }
    motion.finish(record.stability);

    stage.show(scored);
    const int next = scene.timeline.frames(); // of the technique's sequence
    record.cost.work = timing::measureWork(stage, *technique, bytes, next, options.seed);
    if (options.time) record.cost.time = timing::measureTime(stage, variant, *technique, next + 1, options.seed);
    record.status = Status::Scored;
}

} // namespace shadowbench
