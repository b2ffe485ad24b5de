#include "harness/lod/lod_cell.h"

#include "groundtruth/reference.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <xxhash.h>

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
            const ColourImage &full = reference_.pictures[frame], &fullBefore = reference_.pictures[frame - 1];
            lod_.changeByFrame.push_back(metrics::meanChange(picture, before_) - reference_.change[frame]);
            const std::size_t region = metrics::largestChangedRegion(picture, before_, full, fullBefore);
            lod_.changedRegion = std::max<std::uint64_t>(lod_.changedRegion, region);
            const double former = lod_.primitivesByFrame.back();
            lod_.primitiveChange = std::max(lod_.primitiveChange, std::abs(primitives - former) / former);
        }
        squares_ += metrics::meanSquare(picture, reference_.pictures[frame]);
        speckle_ += metrics::speckle(picture, reference_.masks[frame]);
        lod_.primitivesByFrame.push_back(primitives);
        before_ = picture;
    }

    Lod finish() {
        const auto frames = static_cast<double>(lod_.primitivesByFrame.size());
        lod_.pop = *std::ranges::max_element(lod_.changeByFrame);
        lod_.colourError = std::sqrt(squares_ / frames);
        if (reference_.maskPixels > 0)
            lod_.noise = (speckle_ - reference_.speckle) / static_cast<double>(reference_.maskPixels);
        lod_.transitions = reference_.transitions[reference_.busiest];
        for (const double primitives : lod_.primitivesByFrame) lod_.primitives += primitives / frames;
        return std::move(lod_);
    }

private:
    const LodReference& reference_;
    Lod lod_;
    ColourImage before_;
    double squares_ = 0, speckle_ = 0;
};

/// The picture of a frame from an empty history: of the two frames up to it.
ColourImage pictureAt(LodStage& stage, LodTechnique& technique, int frame) {
    technique.reset();
    for (const int index : {frame - 1, frame}) {
        stage.show(index);
        stage.render(technique);
    }
    return stage.picture();
}

/// Root of the mean squared difference that the order of drawing makes, in the middle of each third of the walk.
double orderError(LodScene& lodScene, LodTechnique& technique, int frames) {
    double squares = 0;
    for (const int sixth : {1, 3, 5}) {
        const int frame = std::max(1, sixth * frames / 6);
        const ColourImage ordered = pictureAt(lodScene.stage(), technique, frame);
        squares += metrics::meanSquare(ordered, pictureAt(lodScene.reversedStage(), technique, frame)) / 3;
    }
    return std::sqrt(squares);
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
    const XXH128_hash_t hash = XXH3_128bits(inputs.data(), inputs.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

void runLodCell(LodScene& lodScene, const techniques::Variant& variant, const LodCellOptions& options, Record& record,
                const Progress& progress, const KeepPicture& keep) {
    const int frames = lodScene.scene().lod->frames;
    const LodReference& reference = lodScene.reference(progress);
    LodStage& stage = lodScene.stage();
    std::unique_ptr<LodTechnique> technique = make(variant);
    WalkScores scores(reference);
    record.cost.work.emplace();
    for (int frame = 0; frame < frames; ++frame) {
        progress(static_cast<double>(frame) / frames, fmt::format("{}, frame {} of {}", variant.name, frame + 1, frames));
        stage.show(frame);
        gl::WorkMeter meter;
        stage.render(*technique);
        const gl::WorkCount count = meter.finish();
        const ColourImage picture = stage.picture();
        scores.add(static_cast<std::size_t>(frame), picture, static_cast<double>(count.primitives));
        if (static_cast<std::size_t>(frame) == reference.busiest)
            record.cost.work = {count.fragments, count.vertices, count.primitives, count.draws, count.passes, 0};
        if (keep) keep(frame, picture);
    }
    record.lod = scores.finish();
    record.lod->orderError = orderError(lodScene, *technique, frames);
    if (options.time) {
        LodCost cost = measureLodCost(stage, *technique, frames, options.cost);
        record.lod->time = cost.time;
        record.lod->millisecondsByFrame = std::move(cost.milliseconds);
    }
    record.cost.work->bytes = bytesOf(std::move(technique));
    record.frames = frames;
    record.status = Status::Scored;
}

} // namespace shadowbench::lod
