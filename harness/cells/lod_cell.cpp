#include "harness/cells/lod_cell.h"

#include "base/hash.h"
#include "groundtruth/oracle.h"
#include "harness/measure/lod_cost.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::lod {
namespace {

using metrics::ColourImage;
using techniques::LodTechnique;

std::unique_ptr<LodTechnique> make(const techniques::Variant& variant) { return variant.entry->makeLod(variant.parameters); }

/// Gathers the scores of a walk, picture by picture.
class WalkScores {
public:
    explicit WalkScores(const LodReference& reference) : reference_(reference) {}

    void add(std::size_t frame, const ColourImage& picture, double primitives) {
        if (frame > 0) {
            lod_.walkPopByFrame.push_back(metrics::meanChange(picture, before_) - reference_.change[frame]);
        }
        squares_ += metrics::meanSquare(picture, reference_.pictures[frame]);
        speckle_ += metrics::speckle(picture, reference_.masks[frame]);
        lod_.primitivesByFrame.push_back(primitives);
        before_ = picture;
    }

    Lod finish() {
        const auto frames = static_cast<double>(lod_.primitivesByFrame.size());
        lod_.walkPop = *std::ranges::max_element(lod_.walkPopByFrame);
        lod_.colourError = std::sqrt(squares_ / frames);
        if (reference_.maskPixels > 0)
            lod_.noise = (speckle_ - reference_.speckle) / static_cast<double>(reference_.maskPixels);
        const std::vector<double>& primitives = lod_.primitivesByFrame;
        for (std::size_t frame = 2; frame < primitives.size(); ++frame) // the first one also fills histories
            lod_.primitiveChange =
                std::max(lod_.primitiveChange, std::abs(primitives[frame] - primitives[frame - 1]) / primitives[frame - 1]);
        for (const double count : primitives) lod_.primitives += count / frames;
        lod_.transitions = reference_.transitions[reference_.busiest];
        return std::move(lod_);
    }

private:
    const LodReference& reference_;
    Lod lod_;
    ColourImage before_;
    double squares_ = 0, speckle_ = 0;
};

gl::WorkCount draw(LodStage& stage, LodTechnique& technique, int frame) {
    stage.show(frame);
    gl::WorkMeter meter;
    stage.render(technique);
    return meter.finish();
}

/// Popping where nothing but levels changes.
void scoreStanding(LodStage& stage, LodTechnique& technique, int frames, const Progress& progress, Lod& scores) {
    technique.reset();
    ColourImage before;
    for (int frame = 0; frame < frames; ++frame) {
        progress(static_cast<double>(frame) / frames, fmt::format("standing, frame {} of {}", frame + 1, frames));
        stage.showStanding(frame);
        stage.render(technique);
        ColourImage picture = stage.picture();
        if (frame > 0) {
            scores.popByFrame.push_back(metrics::meanChange(picture, before));
            const std::size_t region = metrics::largestChangedRegion(picture, before);
            scores.changedRegion = std::max<std::uint64_t>(scores.changedRegion, region);
        }
        before = std::move(picture);
    }
    scores.pop = *std::ranges::max_element(scores.popByFrame);
}

/// The picture of a frame from an empty history, which holds the frame before.
ColourImage pictureAt(LodStage& stage, LodTechnique& technique, bool temporal, int frame) {
    technique.reset();
    for (int index = std::max(0, temporal ? frame - 1 : frame); index <= frame; ++index) {
        stage.show(index);
        stage.render(technique);
    }
    return stage.picture();
}

/// Root of the mean squared difference that the order of drawing makes, in the frame with most transitions.
double orderError(LodScene& lodScene, LodTechnique& technique, bool temporal) {
    const int frame = static_cast<int>(lodScene.reference().busiest);
    const ColourImage ordered = pictureAt(lodScene.stage(), technique, temporal, frame);
    return std::sqrt(metrics::meanSquare(ordered, pictureAt(lodScene.reversedStage(), technique, temporal, frame)));
}

/// Bytes of textures and buffers that are the technique's own.
std::uint64_t bytesOf(std::unique_ptr<LodTechnique> technique) {
    const std::uint64_t with = gl::Context::current().tally().bytes;
    technique.reset();
    return with - gl::Context::current().tally().bytes;
}

} // namespace

LodStage& LodScene::stage() {
    if (!stage_) stage_ = std::make_unique<LodStage>(scene_, scene_.size);
    return *stage_;
}

LodStage& LodScene::reversedStage() {
    if (!reversedStage_) {
        reversed_ = withTrianglesReversed(scene_);
        reversedStage_ = std::make_unique<LodStage>(*reversed_, scene_.size);
    }
    return *reversedStage_;
}

const LodReference& LodScene::reference(const Progress& progress) {
    if (!reference_) reference_ = drawReference(stage(), scene_.lod->frames, progress);
    return *reference_;
}

std::optional<std::string> notApplicable(const Scene& scene) {
    if (scene.lod) return std::nullopt;
    return fmt::format("needs a walk past levels of detail; {} has no [lod]", scene.id);
}

std::string lodCellId(const Scene& scene, const techniques::Variant& variant) {
    std::string inputs = fmt::format("schema 1\nlod\n{}\n{}\nframes {}\nband {}\n", scene.id, variant.name,
                                     scene.lod->frames, scene.lod->band);
    for (const Object& object : scene.objects)
        for (const Level& level : object.levels) {
            const glm::vec3 colour = level.colour.value_or(object.colour);
            inputs += fmt::format("{} until {} colour {} {} {}\n", level.mesh->triangles.size(), level.until, colour.x,
                                  colour.y, colour.z);
        }
    // The keys of these two hold cameras, placements and meshes.
    Scene walk = scene;
    walk.timeline = {1, scene.lod->frames - 1};
    walk.eye = scene.lod->eye;
    walk.target = scene.lod->target;
    for (const int frame : {0, scene.lod->frames - 1}) {
        groundtruth::Request request;
        request.snapshot = snapshot(walk, frame);
        request.size = scene.size;
        inputs += groundtruth::key(request) + "\n";
    }
    return hash128(inputs).text();
}

void runLodCell(LodScene& lodScene, const techniques::Variant& variant, const MeasureOptions& options, Record& record,
                const Progress& progress, const KeepPicture& keep) {
    const int frames = lodScene.scene().lod->frames;
    const LodReference& reference = lodScene.reference(progress);
    LodStage& stage = lodScene.stage();
    std::unique_ptr<LodTechnique> technique = make(variant);
    WalkScores scores(reference);
    const bool isReference = variant.entry->id == "lod-full"; // drawn already, and the same whatever levels are selected
    for (int index = 0; index < frames; ++index) {
        progress(static_cast<double>(index) / frames, fmt::format("{}, frame {} of {}", variant.name, index + 1, frames));
        const auto frame = static_cast<std::size_t>(index);
        gl::WorkCount work = reference.work[frame];
        if (!isReference) work = draw(stage, *technique, index);
        const ColourImage picture = isReference ? reference.pictures[frame] : stage.picture();
        scores.add(frame, picture, static_cast<double>(work.primitives));
        if (frame == reference.busiest)
            record.cost.work = {work.fragments, work.vertices, work.primitives, work.draws, work.passes, 0};
        if (keep) keep(index, picture);
    }
    record.lod = scores.finish();
    if (isReference)
        record.lod->popByFrame.assign(static_cast<std::size_t>(frames - 1), 0);
    else
        scoreStanding(stage, *technique, frames, progress, *record.lod);
    record.lod->orderError = orderError(lodScene, *technique, variant.entry->temporal);
    if (options.time) {
        LodCost cost = measureLodCost(stage, *technique, frames);
        record.lod->time = cost.time;
        record.lod->millisecondsByFrame = std::move(cost.milliseconds);
    }
    record.cost.work->bytes = bytesOf(std::move(technique));
    record.frames = frames;
    record.status = Status::Scored;
}

} // namespace shadowbench::lod
