#include "harness/cells/scene_cells.h"

#include "base/trace.h"
#include "harness/cells/cell_images.h"
#include "harness/cells/external_techniques.h"
#include "harness/cells/kept_images.h"
#include "harness/cells/lod_images.h"
#include "harness/measure/frame_passes.h"
#include "harness/metrics/values.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench {
namespace {

/// Whether the scene names the variant; one of a technique that is still to come is named by nobody.
bool names(const std::string& expected, const techniques::Variant& variant) {
    try {
        return techniques::parseVariant(expected).name == variant.name;
    } catch (const BadInput&) {
        return false;
    }
}

/// What the scene is there to break is broken: the bounds that are exceeded are said with the scores.
void markExpectedFailure(const Scene& scene, const techniques::Variant& variant, Record& record) {
    for (const Expectation& expected : scene.expectations) {
        const Bound& bound = expected.bound;
        if (bound.below || !names(expected.technique, variant)) continue;
        const std::optional<double> value = metrics::bounded(record.values, bound.metric);
        if (!value || !bound.isKeptBy(*value)) continue;
        record.status = Status::ExpectedFailure;
        record.reason += fmt::format("{}{} is expected to lie above {:g}: {}", record.reason.empty() ? "" : "; ",
                                     bound.metric, bound.value, expected.reason);
    }
}

} // namespace

SceneCells::SceneCells(const Scene& scene, const groundtruth::Cache& cache, MeasureOptions options)
    : scene_(scene), options_(std::move(options)), cache_(cache), truths_(scene, cache), lodScene_(scene) {}

std::optional<std::string> SceneCells::notApplicable(const techniques::Variant& variant) const {
    if (isExternal(variant)) return options_.external->notApplicable(scene_, variant);
    return variant.isLod() ? lod::notApplicable(scene_) : shadowbench::notApplicable(scene_, variant);
}

std::string SceneCells::id(const techniques::Variant& variant) const {
    const Span span("truth", "keys");
    if (isExternal(variant)) return options_.external->cellId(truths_, scene_, variant);
    return variant.isLod() ? lod::lodCellId(scene_, variant) : cellId(truths_, scene_, variant, options_);
}

Record SceneCells::described(const techniques::Variant& variant) const {
    Record record = blankRecord(scene_, variant, options_.seed);
    if (isExternal(variant)) record.external = options_.external->describe(variant);
    return record;
}

Record SceneCells::blank(const techniques::Variant& variant) const {
    Record record = described(variant);
    if (const auto reason = notApplicable(variant)) {
        record.status = Status::NotApplicable;
        record.reason = *reason;
    }
    return record;
}

Record SceneCells::failed(const techniques::Variant& variant, const std::string& cell, const Error& error) const {
    Record record = described(variant);
    record.cell = cell;
    record.status = Status::Error;
    record.reason = error.what();
    return record;
}

std::vector<std::pair<Truth, int>> SceneCells::truthsOf(const techniques::Variant& variant) const {
    if (isExternal(variant)) return options_.external->truthsOf(scene_, variant);
    std::vector<std::pair<Truth, int>> truths;
    if (variant.isLod()) return truths;
    const int still = scene_.timeline.still - 1;
    for (const int frame : truths_.scoredFrames()) {
        truths.emplace_back(mainTruth(scene_, variant), frame);
        if (usesPixelAreas(scene_, variant)) truths.emplace_back(Truth::PixelArea, frame);
        if (frame == still && hasTruth(scene_.light, Truth::Soft)) truths.emplace_back(Truth::Soft, frame);
        if (frame == still && hasTruth(scene_.light, Truth::Area)) truths.emplace_back(Truth::Area, frame);
    }
    return truths;
}

void SceneCells::computeTruth(Truth truth, int frame, const Progress& progress) {
    const std::string what = fmt::format("{} truth of frame {}", name(truth), frame);
    truths_.at(truth, frame, [&](double share, std::string_view) { progress(share, what); });
}

SceneFrames& SceneCells::frames() {
    if (frames_) return *frames_;
    const Span span("setup", "scene");
    frames_.emplace(scene_, truths_);
    return *frames_;
}

void SceneCells::score(const techniques::Variant& variant, Record& record, const Progress& progress) {
    if (variant.isLod()) return scoreLod(variant, record, progress);
    for (const auto& [truth, frame] : truthsOf(variant)) computeTruth(truth, frame, progress);
    progress(0, variant.name);
    CellImages images;
    images.wantsFlicker = !options_.images.empty();
    if (isExternal(variant))
        options_.external->score(frames(), variant, record, images, progress);
    else
        scoreOwn(variant, record, images);
    markExpectedFailure(scene_, variant, record);
    if (!options_.images.empty()) keepImages(variant, images);
}

void SceneCells::keepImages(const techniques::Variant& variant, const CellImages& images) {
    const Span span("files", "images");
    keepCell(imageFolder(variant), images);
    if (!shading_) {
        shading_ = pictureShading(frames());
        keepShading(shadingFile(options_.images, scene_.id), *shading_);
    }
    if (options_.pictures) writeCellImages(imageFolder(variant), images, *shading_);
    for (const auto& [truth, frame] : truthsOf(variant))
        if (frame == scene_.timeline.still - 1 && keptTruths_.insert(truth).second)
            keepTruth(truthFile(options_.images, scene_.id, name(truth)), truths_.at(truth, frame));
    const Truth moving = movingTruth(variant);
    if (images.frames.size() > 1 && keptSequences_.insert(moving).second)
        keepSequence(truthSequenceFile(options_.images, scene_.id, name(moving)), truthSequence(moving));
}

Truth SceneCells::movingTruth(const techniques::Variant& variant) const {
    if (!isExternal(variant)) return sequenceTruth(scene_, variant);
    const std::vector<std::pair<Truth, int>> truths = truthsOf(variant); // its own first
    const bool areas = std::ranges::find(truths, Truth::PixelArea, &std::pair<Truth, int>::first) != truths.end();
    return areas ? Truth::PixelArea : truths.front().first;
}

std::vector<Image<float>> SceneCells::truthSequence(Truth truth) {
    std::vector<Image<float>> images;
    for (const int frame : truths_.scoredFrames()) images.push_back(truths_.at(truth, frame).visibility);
    return images;
}

void SceneCells::scoreOwn(const techniques::Variant& variant, Record& record, CellImages& images) {
    scoreCell(frames(), variant, options_.seed, record, images);
    if (options_.seeds > 1) {
        const Span span("extra", "seeds");
        splitErrorOverSeeds(frames(), variant, options_.seed, options_.seeds, images.visibility(), record);
    }
    scoreBeside(variant, record);
}

/// What is asked for of the same row on copies of the scene.
void SceneCells::scoreBeside(const techniques::Variant& variant, Record& record) {
    if (options_.neighbours) {
        const Span span("extra", "neighbours");
        if (!neighbour_) neighbour_ = std::make_unique<ChangedScene>(withNeighbourImage(scene_), cache_);
        scoreNeighbourMap(frames(), variant, options_.seed, record);
        scoreNeighbourImage(neighbour_->frames(), variant, options_.seed, record);
    }
    if (options_.views < 2) return;
    const Span span("extra", "views");
    if (otherViews_.empty())
        for (Scene& view : otherViews(scene_, options_.views))
            otherViews_.push_back(std::make_unique<ChangedScene>(std::move(view), cache_));
    scoreViews(scene_, otherViews_, variant, options_.seed, record);
}

void SceneCells::scoreLod(const techniques::Variant& variant, Record& record, const Progress& progress) {
    lod::KeepPicture keep;
    std::optional<lod::LodImages> images;
    if (options_.pictures) {
        images.emplace(lodScene_.reference(progress));
        keep = [&images](int frame, const metrics::ColourImage& picture) { images->keep(frame, picture); };
    }
    lod::scoreLodCell(lodScene_, variant, record, progress, keep);
    markExpectedFailure(scene_, variant, record);
    if (images) images->write(imageFolder(variant));
}

void SceneCells::time(const techniques::Variant& variant, Record& record) {
    if (isExternal(variant)) return;
    const Span span("cost", "times");
    if (variant.isLod()) {
        if (options_.time) timeLod(variant, record);
        if (options_.otherScreen) record.otherScreen = lod::measureOtherScreen(lodScene_, variant);
        return;
    }
    if (options_.time && timing::hasDeviceClock())
        timing::setTimes(record, device().measure(scene_, variant, frames().scored(), options_.seed));
    else if (options_.time)
        timeCell(frames(), variant, options_.seed, record);
    if (options_.otherScreen)
        record.otherScreen = timing::measureOtherScreen(scene_, variant, frames().scored(), options_.seed);
}

void SceneCells::timeLod(const techniques::Variant& variant, Record& record) {
    lod::timeLodCell(lodScene_, variant, record);
    if (!timing::hasDeviceClock()) return;
    const int busiest = static_cast<int>(lodScene_.reference().busiest);
    timing::setLodTimes(record, device().measureLod(scene_, variant, busiest));
}

timing::DeviceMeter& SceneCells::device() {
    if (!device_) device_ = std::make_unique<timing::DeviceMeter>();
    return *device_;
}

void SceneCells::measure(const techniques::Variant& variant, Record& record, const Progress& progress) {
    score(variant, record, progress);
    time(variant, record);
}

std::filesystem::path SceneCells::imageFolder(const techniques::Variant& variant) const {
    return cellFolder(options_.images, scene_.id, variant.name);
}

} // namespace shadowbench
