#include "harness/cells/lod_cell.h"

#include "base/hash.h"
#include "groundtruth/oracle.h"
#include "harness/measure/frame_passes.h"
#include "harness/measure/lod_cost.h"
#include "harness/metrics/frames.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::lod {
namespace {

using metrics::ColourImage;
using techniques::LodTechnique;

std::unique_ptr<LodTechnique> make(const techniques::Variant& variant) { return variant.entry->makeLod(variant.parameters); }

/// What the pictures along the walk give, one after the other.
class WalkPictures {
public:
    WalkPictures(const LodReference& reference, metrics::Walk& walk) : reference_(reference), walk_(walk) {
        walk_.referenceSpeckle = reference.speckle;
        walk_.maskPixels = reference.maskPixels;
        walk_.transitions = reference.transitions[reference.busiest];
    }

    void add(std::size_t frame, const ColourImage& picture, double primitives) {
        if (frame > 0) walk_.change.push_back(metrics::meanChange(picture, before_) - reference_.change[frame]);
        walk_.square.push_back(metrics::meanSquare(picture, reference_.pictures[frame]));
        walk_.speckle.push_back(metrics::speckle(picture, reference_.masks[frame]));
        walk_.primitives.push_back(primitives);
        before_ = picture;
    }

private:
    const LodReference& reference_;
    metrics::Walk& walk_;
    ColourImage before_;
};

gl::WorkCount draw(LodStage& stage, LodTechnique& technique, int frame) {
    stage.show(frame);
    gl::WorkMeter meter;
    stage.render(technique);
    return meter.finish();
}

/// Draws the frames in which nothing but levels changes.
void drawStanding(LodStage& stage, LodTechnique& technique, int frames, const Progress& progress, metrics::Walk& walk) {
    technique.reset();
    ColourImage before;
    for (int frame = 0; frame < frames; ++frame) {
        progress(static_cast<double>(frame) / frames, fmt::format("standing, frame {} of {}", frame + 1, frames));
        stage.showStanding(frame);
        stage.render(technique);
        ColourImage picture = stage.picture();
        if (frame > 0) {
            walk.standingChange.push_back(metrics::meanChange(picture, before));
            walk.standingRegion.push_back(metrics::largestChangedRegion(picture, before));
        }
        before = std::move(picture);
    }
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

/// The mean squared difference that the order of drawing makes, in the frame with most transitions.
double orderSquare(LodScene& lodScene, LodTechnique& technique, bool temporal) {
    const int frame = static_cast<int>(lodScene.reference().busiest);
    const ColourImage ordered = pictureAt(lodScene.stage(), technique, temporal, frame);
    return metrics::meanSquare(ordered, pictureAt(lodScene.reversedStage(), technique, temporal, frame));
}

/// The passes of `frame` when it is shown again, from an empty history on: of techniques that draw levels in turn always the
/// same turn.
std::vector<PassRecord> passesOf(LodStage& stage, LodTechnique& technique, bool temporal, std::size_t frame, bool timed) {
    constexpr int rounds = 5;
    (void)pictureAt(stage, technique, temporal, static_cast<int>(frame));
    const auto render = [&](techniques::PassListener& listener) { stage.render(technique, &listener); };
    timing::FramePasses passes = timing::countPasses(render);
    if (timed) timing::timePasses(passes, render, rounds);
    return timing::passRecords(passes, timed);
}

/// Bytes of textures and buffers that are the technique's own.
std::uint64_t bytesOf(std::unique_ptr<LodTechnique> technique) {
    const std::uint64_t with = gl::Context::current().tally().bytes;
    technique.reset();
    return with - gl::Context::current().tally().bytes;
}

/// Everything that the pictures of a variant along the scene's walk depend on.
std::string walkOf(const Scene& scene, const std::string& variant) {
    std::string inputs =
        fmt::format("schema 1\nlod\n{}\n{}\nframes {}\nband {}\n", scene.id, variant, scene.lod->frames, scene.lod->band);
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
    for (const int frame : {0, scene.lod->frames - 1})
        inputs += groundtruth::key(groundtruth::Request(snapshot(walk, frame), scene.size)) + "\n";
    return inputs;
}

/// The truth of such a cell: the same walk at the finest levels, drawn by the rasteriser that draws the cell.
ReferenceInfo describe(const LodReference& reference, const Scene& scene) {
    ReferenceInfo info;
    info.oracle = "lod-full";
    info.key = hash128(walkOf(scene, info.oracle)).text();
    info.content = reference.content;
    return info;
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
    return hash128(walkOf(scene, variant.name)).text();
}

void scoreLodCell(LodScene& lodScene, const techniques::Variant& variant, Record& record, const Progress& progress,
                  const KeepPicture& keep) {
    const int frames = lodScene.scene().lod->frames;
    const LodReference& reference = lodScene.reference(progress);
    LodStage& stage = lodScene.stage();
    std::unique_ptr<LodTechnique> technique = make(variant);
    metrics::Walk walk;
    WalkPictures pictures(reference, walk);
    Hasher128 shown;
    gl::WorkCount busiest;
    const bool isReference = variant.entry->id == "lod-full"; // drawn already, and the same whatever levels are selected
    for (int index = 0; index < frames; ++index) {
        progress(static_cast<double>(index) / frames, fmt::format("{}, frame {} of {}", variant.name, index + 1, frames));
        const auto frame = static_cast<std::size_t>(index);
        gl::WorkCount work = reference.work[frame];
        if (!isReference) work = draw(stage, *technique, index);
        const ColourImage picture = isReference ? reference.pictures[frame] : stage.picture();
        pictures.add(frame, picture, static_cast<double>(work.primitives));
        shown.add(picture.data(), picture.size() * sizeof(*picture.data()));
        if (frame == reference.busiest) busiest = work;
        if (keep) keep(index, picture);
    }
    if (isReference)
        walk.standingChange.assign(static_cast<std::size_t>(frames - 1), 0);
    else
        drawStanding(stage, *technique, frames, progress, walk);
    walk.orderSquare = orderSquare(lodScene, *technique, variant.entry->temporal);
    metrics::compute<metrics::OfWalk>(walk, record.values);
    record.values.list("lod.by_frame.pop") = walk.standingChange;
    record.values.list("lod.by_frame.walk_pop") = walk.change;
    record.values.list("lod.by_frame.primitives") = walk.primitives;
    record.passes = passesOf(stage, *technique, variant.entry->temporal, reference.busiest, false);
    record.images = shown.digest().text();
    setWork(record, WorkOf::StandingFrame, busiest);
    setMemory(record, {bytesOf(std::move(technique))});
    record.frames = frames;
    record.reference = describe(reference, lodScene.scene());
    record.status = Status::Scored;
}

void timeLodCell(LodScene& lodScene, const techniques::Variant& variant, Record& record) {
    LodStage& stage = lodScene.stage();
    const std::unique_ptr<LodTechnique> technique = make(variant);
    const LodCost cost = measureLodCost(stage, *technique, lodScene.scene().lod->frames);
    record.passes = passesOf(stage, *technique, variant.entry->temporal, lodScene.reference().busiest, true);
    setTime(record, cost.time);
    record.values.list("lod.by_frame.milliseconds") = cost.milliseconds;
}

OtherScreen measureOtherScreen(LodScene& lodScene, const techniques::Variant& variant) {
    const glm::ivec2 size = timing::otherScreen(lodScene.scene());
    LodStage stage(lodScene.scene(), size);
    const std::unique_ptr<LodTechnique> technique = make(variant);
    return {size.x, size.y, passesOf(stage, *technique, variant.entry->temporal, lodScene.reference().busiest, true)};
}

} // namespace shadowbench::lod
