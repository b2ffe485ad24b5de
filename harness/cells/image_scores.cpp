#include "harness/cells/image_scores.h"

#include "base/error.h"
#include "base/trace.h"
#include "groundtruth/area_comparison.h"
#include "harness/metrics/frames.h"
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <optional>
#include <utility>
#include <vector>

namespace shadowbench {
namespace {

using groundtruth::Reference;
using metrics::Mask;

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

/// How far the shown frame's soft truth, and `v`, are from the exact visible fraction.
AreaInfo besideArea(SceneFrames& frames, const Receivers& receivers, const Image<float>& v) {
    const Reference& exact = frames.truth(Truth::Area);
    const double rms = groundtruth::penumbraError(frames.truth(Truth::Soft), exact).rms;
    return {exact.provenance.key, frames.truths().content(Truth::Area, frames.scored()), rms,
            metrics::rmse({v, exact, receivers(Truth::Area)}).value_or(0)};
}

/// The receivers of what is shown. Throws InternalError where rasteriser and truth see other surfaces.
const Mask& alignedMask(const Receivers& receivers, Truth truth, int frame) {
    const Mask& mask = receivers(truth);
    if (mask.aligned) return mask;
    throw InternalError(fmt::format(
        "the rasteriser and the ground truth disagree on the primary hit of {:.2f} % of the pixels of frame {} "
        "(limit 0.10 %), so no score is given: two faces lie in one plane (move one), or surfaces are too near to "
        "each other for single precision (shadowbench inspect SCENE says why), or details are a small part of a pixel "
        "wide (take the camera nearer)",
        100 * mask.primaryMismatch, frame));
}

/// Metrics of one frame against one truth, of those kinds that fit it.
template <class Kind>
void score(const metrics::ScoredFrame& frame, Record& record) {
    metrics::compute<Kind>(frame, record.values);
    std::optional<double>& worst = record.values["accuracy.primary_mismatch"];
    worst = std::max(worst.value_or(0), frame.mask.primaryMismatch);
}

/// How many times the error of an image without shadows `v` has; nothing where that has none.
std::optional<double> timesNone(Truth truth, const metrics::ScoredFrame& frame) {
    const Image<float> lit(frame.v.width(), frame.v.height(), 1.0F);
    const std::optional<double> none = errorBy(truth, {lit, frame.truth, frame.mask}), own = errorBy(truth, frame);
    return none && *none > 0 ? std::optional(own.value() / *none) : std::nullopt;
}

/// The last still frame, which is shown, against every truth it is scored by (docs/metrics.md, "Which truth a cell is scored
/// against").
void scoreStillFrame(SceneFrames& frames, const ScoringRule& rule, const Receivers& receivers, const Image<float>& v,
                     Record& record) {
    const Scene& scene = frames.scene();
    const int frame = frames.scored();
    const auto described = [&](Truth truth) { return describe(frames.truth(truth), frames.truths().content(truth, frame)); };
    const auto scorePicture = [&](Truth truth) {
        const metrics::ScoredFrame scored{v, frames.truth(truth), receivers(truth)};
        metrics::compute<metrics::OfPicture>(metrics::ShadedFrame{scored, frames.shading(), frames.truePicture(truth)},
                                             record.values);
    };
    const auto scoreSoft = [&](Truth truth, std::optional<ReferenceInfo>& reference) {
        reference = described(truth);
        if (truth == Truth::Soft && scene.light.isArea()) reference->area = besideArea(frames, receivers, v);
        score<metrics::OfVisibility>({v, frames.truth(truth), alignedMask(receivers, truth, frame)}, record);
        scorePicture(truth);
    };
    record.values["sanity.times_none"] =
        timesNone(rule.truth, {v, frames.truth(rule.truth), alignedMask(receivers, rule.truth, frame)});
    if (rule.truth != Truth::Hard) return scoreSoft(rule.truth, record.reference);
    const metrics::ScoredFrame labels{v, frames.truth(Truth::Hard), alignedMask(receivers, Truth::Hard, frame)};
    record.reference = described(Truth::Hard);
    score<metrics::OfLabels>(labels, record);
    if (scene.light.isArea())
        scoreSoft(Truth::Soft, record.softReference);
    else
        scorePicture(Truth::Hard);
    if (rule.graded && !scene.light.isArea()) score<metrics::OfVisibility>(labels, record);
    if (!rule.pixelAreas) return;
    record.pixelReference = described(Truth::PixelArea);
    if (!scene.light.isArea())
        score<metrics::OfPixelAreas>({v, frames.truth(Truth::PixelArea), receivers(Truth::PixelArea)}, record);
}

/// The still frames from an empty history. Labels are compared with the images' own truth, graded visibility with the
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
    /// `remembers`: the renderer has a history.
    MovingFrameScores(Truth truth, bool remembers) : truth_(truth) { frames_.remembers = remembers; }

    /// Adds what is shown, of which `v` is the answer.
    void add(SceneFrames& frames, const Receivers& receivers, const Image<float>& v) {
        const Kept& now = kept_.emplace_back(Kept{v, frames.truth(truth_), receivers(truth_)});
        if (kept_.size() == 1) return;
        const Kept& before = kept_[kept_.size() - 2];
        frames_.pairs.push_back({{now.v, now.truth, now.mask}, {before.v, before.truth, before.mask}, frames.warp(truth_)});
        frames_.motion += frames.motion(truth_);
    }

    template <class Kind>
    void finish(metrics::Values& values) const {
        metrics::compute<Kind>(frames_, values);
    }

    [[nodiscard]] std::vector<Image<float>> flickerMaps() const {
        std::vector<Image<float>> maps;
        for (const metrics::FramePair& pair : frames_.pairs) {
            if (maps.empty()) maps.emplace_back(pair.now.v.width(), pair.now.v.height());
            maps.push_back(metrics::flickerMap(pair));
        }
        return maps;
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

/// What visibility is graded against frame by frame: images of another meaning by their own truth.
Truth gradedBy(const Scene& scene, const ScoringRule& rule) {
    return rule.truth == Truth::Hard ? gradedTruth(scene) : rule.truth;
}

} // namespace

struct ImageScores::Sequences {
    std::optional<StillFrameScores> still; // of renderers with a history
    MovingFrameScores moving, movingAreas;
};

bool usesPixelAreas(const Scene& scene, Truth truth) {
    return truth == Truth::Hard && (scene.timeline.moving > 0 || !scene.light.isArea());
}

std::optional<double> errorBy(Truth truth, const metrics::ScoredFrame& frame) {
    return truth == Truth::Hard ? metrics::labelErrors(frame).mismatch : metrics::rmse(frame);
}

Truth gradedTruth(const Scene& scene) { return hasTruth(scene.light, Truth::Soft) ? Truth::Soft : Truth::Hard; }

ImageScores::ImageScores(SceneFrames& frames, const ScoringRule& rule, Receivers receivers, std::string variant)
    : frames_(frames), rule_(rule), receivers_(std::move(receivers)), variant_(std::move(variant)) {
    const bool remembers = rule.stillFrames || rule.remembers;
    const Truth areas = rule.pixelAreas ? Truth::PixelArea : rule.truth;
    sequences_ = std::make_unique<Sequences>(
        Sequences{{}, MovingFrameScores(rule.truth, remembers), MovingFrameScores(areas, remembers)});
    if (!rule.stillFrames) return;
    Truths& truths = frames.truths();
    sequences_->still.emplace(truths.at(rule.truth, frames.scored()),
                              truths.at(gradedBy(frames.scene(), rule), frames.scored()), rule.truth == Truth::Hard);
}

ImageScores::~ImageScores() = default;

void ImageScores::add(int frame, const Image<float>& v, Record& record) {
    const Span span("metrics", "frame");
    shown_.add(v.data(), v.size() * sizeof(float));
    const Mask& mask = alignedMask(receivers_, rule_.truth, frame);
    requireAnswers(v, mask, variant_, frame);
    auto& [still, moving, movingAreas] = *sequences_;
    if (still && frame <= frames_.scored()) still->add(v, mask, receivers_(gradedBy(frames_.scene(), rule_)), record.values);
    if (frame < frames_.scored()) return;
    if (frame == frames_.scored()) {
        if (still) still->finish(mask, record.values);
        scoreStillFrame(frames_, rule_, receivers_, v, record);
    }
    movingAreas.add(frames_, receivers_, v);
    moving.add(frames_, receivers_, v);
    addTruths(frame);
}

void ImageScores::addTruths(int frame) {
    Truths& truths = frames_.truths();
    const auto add = [&](Truth truth) {
        for (const std::string& text : {truths.key(truth, frame), truths.content(truth, frame)})
            truths_.add(text.data(), text.size());
    };
    add(rule_.truth);
    if (rule_.pixelAreas) add(Truth::PixelArea);
}

void ImageScores::finish(Record& record) const {
    const Span span("metrics", "sequence");
    sequences_->moving.finish<metrics::OfMovingFrames>(record.values);
    sequences_->movingAreas.finish<metrics::OfMovingAreas>(record.values);
    record.images = shown_.digest().text();
    record.truths = truths_.digest().text();
}

std::vector<Image<float>> ImageScores::flickerMaps() const {
    const Span span("metrics", "flicker");
    return sequences_->movingAreas.flickerMaps();
}

} // namespace shadowbench
