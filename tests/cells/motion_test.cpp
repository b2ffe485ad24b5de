// What a frame costs in motion and from cold.
#include "harness/metrics/table.h"
#include "harness/render/motion.h"

#include "scene/meshes/primitives.h"
#include "scene/sky.h"
#include "tests/support/cell_stage.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

Scene twoBoxes(Light light) {
    Scene scene;
    scene.light = std::move(light);
    Object object;
    object.levels.push_back({std::make_shared<const Mesh>(box({30, 0, 40}))});
    object.instances = {{}, {}};
    scene.objects.push_back(object);
    return scene;
}

TEST(Motion, ShiftsNeighboursAgainstEachOtherByAHundredthOfTheScene) {
    const Snapshot standing = snapshot(twoBoxes({}), 0);
    const Snapshot away = displaced(standing, Casters::Move);
    const auto& placements = away.batches.at(0).placements;
    ASSERT_EQ(placements.size(), 2U);
    EXPECT_NEAR(placements[0].world[3].x, 0.5, 1e-6); // of 30² + 40² = 50²; the first id is odd
    EXPECT_NEAR(placements[1].world[3].x, -0.5, 1e-6);
    EXPECT_EQ(placements[0].previous, standing.batches[0].placements[0].world);
    EXPECT_TRUE(away.batches[0].moving);
    EXPECT_NEAR(away.light.centre.x - standing.light.centre.x, 0.5, 1e-6);
}

TEST(Motion, ReturnsToTheStandingFrameFromElsewhere) {
    const Snapshot standing = snapshot(twoBoxes({}), 0);
    const Snapshot home = returned(standing, Casters::Move), away = displaced(standing, Casters::Move);
    EXPECT_EQ(home.light, standing.light);
    EXPECT_EQ(home.camera, home.previousCamera);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(home.batches[0].placements[i].world, standing.batches[0].placements[i].world);
        EXPECT_EQ(home.batches[0].placements[i].previous, away.batches[0].placements[i].world);
    }
    EXPECT_TRUE(home.batches[0].moving);
    EXPECT_FALSE(returned(standing, Casters::Stand).batches[0].moving);
}

TEST(Motion, MovesLightsOfEveryKind) {
    EnvironmentLight constant, harmonic, image, sunny;
    harmonic.sky = HarmonicSky{{1, 0.2, 0.1, 0}};
    image.sky = ImageSky{Image<float>(4, 2, 1.0F)};
    sunny.suns = {Sun{}};
    std::vector<Light> lights = {environmentLight(constant), environmentLight(harmonic), environmentLight(image),
                                 environmentLight(sunny)};
    for (const LightKind kind :
         {LightKind::Point, LightKind::Directional, LightKind::Rectangle, LightKind::Disk, LightKind::Line})
        for (const glm::dvec3& direction : {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)})
            lights.push_back({kind, {1, 2, 3}, direction, {1, 0, 0}, {0, 0, 1}});
    for (const Light& light : lights) {
        const Light moved = displaced(snapshot(twoBoxes(light), 0), Casters::Stand).light;
        EXPECT_FALSE(moved == light) << name(light.kind);
        EXPECT_NEAR(glm::length(moved.direction), 1, 1e-12) << name(light.kind);
    }
    const Light sun = displaced(snapshot(twoBoxes(environmentLight(sunny)), 0), Casters::Stand).light;
    EXPECT_NEAR(glm::dot(sun.environment->suns[0].direction, sunny.suns[0].direction), std::cos(0.01), 1e-9);
}

TEST(Motion, LeavesCastersWhereATechniqueIsOfThoseThatStand) {
    const Scene sky = loadScene("constant-sky", Profile::Gate);
    EXPECT_EQ(castersUnder(*techniques::parseVariant("prt-sh").entry, sky), Casters::Stand);
    EXPECT_EQ(castersUnder(*techniques::parseVariant("none").entry, sky), Casters::Move);
    const Scene plates = loadScene("overlapping-occluders", Profile::Gate);
    for (const techniques::Variant& variant : techniques::matchVariants("*")) {
        if (variant.isLod() || notApplicable(plates, variant)) continue;
        EXPECT_EQ(castersUnder(*variant.entry, plates), Casters::Move) << variant.name;
    }
}

using Counts = std::array<double, 5>;

enum class Frame { Standing, Moving };

Counts workOf(const Record& record, Frame frame) {
    const char* group = frame == Frame::Standing ? "cost.work" : "cost.motion.work";
    Counts counts{};
    const auto lines = metrics::linesOf(group);
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = record.values[lines[i]].value();
    return counts;
}

double valueOf(const Record& record, metrics::MetricId id) { return record.values[id].value(); }

bool hasPass(const std::vector<PassRecord>& passes, const std::string& name) {
    return std::ranges::find(passes, name, &PassRecord::name) != passes.end();
}

CellScene& plates() { return stillScene("overlapping-occluders", 1); }

TEST(CellWork, IsAllThatIsMissingWhereItIsLeftOut) {
    for (const char* variant : {"sm-adaptive", "layered-attenuation:n=16,map=128", "pcf-jitter", "sm-history"}) {
        const Record &counted = plates().counted(variant), &scored = plates().scored(variant);
        EXPECT_EQ(scored.images, counted.images) << variant;
        for (const char* group : {"accuracy", "stability", "aliasing"})
            for (const metrics::Metric& line : metrics::linesOf(group))
                EXPECT_EQ(scored.values[line], counted.values[line]) << variant << " " << line.path;
        EXPECT_EQ(scored.figures, counted.figures) << variant;
        EXPECT_TRUE(counted.values["cost.work.draws"]) << variant;
        EXPECT_FALSE(scored.values["cost.work.draws"]) << variant;
    }
}

TEST(CostInMotion, IsThatOfTheStandingFrameForTechniquesThatKeepNothing) {
    for (const char* variant :
         {"none", "sm-uniform", "sm-lispsm", "sm-cascaded", "sm-tiled", "sm-adaptive:cache=off", "sm-clipmap:cache=off",
          "pcf", "vsm", "pcss", "sampled-maps:n=4", "volume-zfail", "penumbra-wedge", "planar-soft:n=4"}) {
        const Record& record = plates().counted(variant);
        EXPECT_EQ(workOf(record, Frame::Moving), workOf(record, Frame::Standing)) << variant;
        EXPECT_TRUE(record.motionPasses.empty()) << variant;
    }
}

/// The image of a frame after one that was drawn `away` from it, by what the technique has kept, and by a new one.
std::pair<Image<float>, Image<float>> keptAndNew(CellScene& cells, const std::string& name, const Snapshot& away) {
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto kept = variant.entry->make(variant.parameters), fresh = variant.entry->make(variant.parameters);
    Stage& stage = cells.stage();
    stage.show(away);
    stage.render(*kept, 0, 1);
    stage.show(returned(snapshot(cells.scene(), 0), Casters::Move));
    stage.render(*kept, 1, 1);
    Image<float> image = stage.visibility();
    stage.render(*fresh, 1, 1);
    return {std::move(image), stage.visibility()};
}

void expectNothingStale(CellScene& cells, const std::string& variant) {
    const Snapshot standing = snapshot(cells.scene(), 0);
    Snapshot castersAway = displaced(standing, Casters::Move);
    castersAway.light = standing.light;
    for (const Snapshot& away : {castersAway, displaced(standing, Casters::Stand)}) {
        const auto [kept, fresh] = keptAndNew(cells, variant, away);
        EXPECT_EQ(kept, fresh) << variant;
    }
}

CellScene& smallSky() {
    testContext(); // outlives the scene
    static CellScene cells([] {
        Scene scene = loadScene("constant-sky", Profile::Gate);
        scene.size = {64, 64};
        scene.referenceSamples = 256;
        scene.timeline = {1, 0};
        return scene;
    }());
    return cells;
}

TEST(WhatIsKept, IsDroppedWhereLightOrCastersAloneHaveMoved) {
    for (const char* variant : {"sm-adaptive", "sm-clipmap", "layered-attenuation:n=16,map=128"})
        expectNothingStale(plates(), variant);
    for (const char* variant : {"prt-sh:points=256,directions=64", "prt-haar:points=256,rays=1,resolution=16"})
        expectNothingStale(smallSky(), variant);
}

TEST(WhatIsKept, IsDroppedWhereACasterHasMovedThatLeavesTheLightsViewAsItIs) {
    testContext();
    Scene scene;
    scene.size = {64, 64};
    scene.timeline = {1, 0};
    scene.camera = {{0.3, 3.1, 5.2}, {0.1, 0, 0}, {0, 1, 0}, 40, 0.1, 50};
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0, -1, 0.4)), {}, {}}; // across x
    Object ground, caster;
    ground.levels.push_back({std::make_shared<const Mesh>(box({8, 0.2, 8}))});
    ground.instances = {{}};
    caster.levels.push_back({std::make_shared<const Mesh>(box({0.5, 2, 0.5}))});
    caster.instances = {{}};
    scene.objects = {ground, caster};
    CellScene cells(scene);
    Snapshot away = snapshot(scene, 0);
    away.batches.back().placements[0].world[3].x += 0.7;
    for (const char* variant : {"sm-adaptive", "sm-clipmap"}) {
        const auto [kept, fresh] = keptAndNew(cells, variant, away);
        EXPECT_EQ(kept, fresh) << variant;
    }
}

TEST(CostInMotion, OfLayeredAttenuationHasItsMaps) {
    const Record& record = plates().counted("layered-attenuation:n=64,map=64");
    const Snapshot shown = snapshot(plates().scene(), 0);
    const double maps = 64, vertices = 3.0 * static_cast<double>(shown.triangles());
    EXPECT_GE(valueOf(record, "cost.motion.work.vertices") - valueOf(record, "cost.work.vertices"), maps * vertices);
    EXPECT_GE(valueOf(record, "cost.motion.work.draws") - valueOf(record, "cost.work.draws"),
              maps * static_cast<double>(shown.batches.size()));
    EXPECT_EQ(valueOf(record, "cost.cold.work.vertices"), valueOf(record, "cost.motion.work.vertices"));
    EXPECT_FALSE(record.motionPasses.empty() || record.coldPasses.empty());
}

TEST(CostInMotion, OfAnAdaptiveMapHasAPassAPage) {
    const Record& kept = plates().counted("sm-adaptive");
    const Record& drawn = plates().counted("sm-adaptive:cache=off");
    EXPECT_EQ(workOf(kept, Frame::Moving), workOf(drawn, Frame::Standing));
    EXPECT_EQ(valueOf(kept, "cost.motion.work.passes") - valueOf(kept, "cost.work.passes"), kept.figures.at("pages"));
}

TEST(CostInMotion, OfPrecomputedTransferIsTheLightsProjectionAndTheFirstFramesTheRest) {
    for (const char* variant : {"prt-sh:points=256,directions=64", "prt-haar:points=256,rays=1,resolution=16"}) {
        const Record& record = smallSky().counted(variant);
        EXPECT_FALSE(hasPass(record.passes, "precomputation") || hasPass(record.passes, "light projection")) << variant;
        EXPECT_FALSE(hasPass(record.motionPasses, "precomputation")) << variant;
        EXPECT_TRUE(hasPass(record.motionPasses, "light projection")) << variant;
        EXPECT_TRUE(hasPass(record.coldPasses, "precomputation") && hasPass(record.coldPasses, "light projection"))
            << variant;
    }
}

TEST(CostInMotion, IsTimedBesideSmUniformInTheSameRounds) {
    CellScene& cells = plates();
    Record layered = cells.counted("layered-attenuation:n=64,map=64"), uniform = cells.counted("sm-uniform");
    timeCell(cells.frames(), techniques::parseVariant("layered-attenuation:n=64,map=64"), 1, layered);
    timeCell(cells.frames(), techniques::parseVariant("sm-uniform"), 1, uniform);
    EXPECT_GT(valueOf(layered, "cost.motion.time.ratio"), 1.5 * valueOf(layered, "cost.time.ratio"));
    EXPECT_GT(valueOf(layered, "cost.cold.time"), 1.5 * valueOf(layered, "cost.time.median"));
    EXPECT_GE(valueOf(layered, "cost.cold.compile"), 0); // the difference of two frames: noise may take it
    EXPECT_FALSE(layered.values.list("cost.motion.time.samples").empty());
    EXPECT_TRUE(std::ranges::all_of(layered.motionPasses, [](const PassRecord& p) { return p.milliseconds.has_value(); }));
    EXPECT_NEAR(valueOf(uniform, "cost.motion.time.ratio"), 1, 0.5); // itself, on a machine that other tests keep busy
}

TEST(PeakMemory, IsAtLeastWhatIsHeldBetweenFrames) {
    for (const char* variant : {"sm-uniform", "layered-attenuation:n=64,map=64", "sm-adaptive", "temporal-soft", "vsm"}) {
        const Record& record = plates().counted(variant);
        EXPECT_GE(valueOf(record, "cost.work.peak_bytes"), valueOf(record, "cost.work.bytes")) << variant;
    }
    gl::Tally& tally = gl::Context::current().tally();
    const std::uint64_t before = tally.bytes;
    tally.watchPeak();
    { const gl::Texture passing(gl::Format::R32F, {64, 32}); }
    EXPECT_EQ(tally.peak - before, 64U * 32 * 4);
    EXPECT_EQ(tally.bytes, before);
}

} // namespace
} // namespace shadowbench
