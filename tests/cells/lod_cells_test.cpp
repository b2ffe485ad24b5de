// What level-of-detail techniques must show on the dissertation's three scenes, in the gate profile.
#include "harness/cells/lod_cell.h"
#include "harness/render/walk.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "tests/support/test_context.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace shadowbench {
namespace {

/// A scene's walk, whose cells are scored once each.
class Walk {
public:
    explicit Walk(const std::string& sceneId) : scene_(loadScene(sceneId, Profile::Gate)), cells_(scene_) {}

    const Record& scored(const std::string& variant) {
        if (const auto found = records_.find(variant); found != records_.end()) return found->second;
        const auto silent = [](double, std::string_view) {};
        Record record;
        lod::scoreLodCell(cells_, techniques::parseVariant(variant), record, silent, {});
        return records_.emplace(variant, std::move(record)).first->second;
    }

    OtherScreen otherScreen(const std::string& variant) {
        return lod::measureOtherScreen(cells_, techniques::parseVariant(variant));
    }

private:
    Scene scene_;
    lod::LodScene cells_; // with the reference that they are compared with
    std::map<std::string, Record> records_;
};

Walk& walkIn(const std::string& scene) {
    testContext(); // outlives the walks
    static std::map<std::string, Walk> walks;
    return walks.try_emplace(scene, scene).first->second;
}

const Record& lodCell(const std::string& scene, const std::string& variant) { return walkIn(scene).scored(variant); }

const metrics::Values& scores(const std::string& scene, const std::string& variant) {
    return lodCell(scene, variant).values;
}

class LodScenes : public testing::TestWithParam<std::string> {};

TEST_P(LodScenes, TheFinestLevelIsItsOwnReference) {
    const metrics::Values& full = scores(GetParam(), "lod-full");
    EXPECT_EQ(*full["lod.pop"], 0);
    EXPECT_EQ(*full["lod.walk_pop"], 0);
    EXPECT_EQ(*full["lod.changed_region"], 0U);
    EXPECT_EQ(*full["lod.colour_error"], 0);
    EXPECT_EQ(*full["lod.noise"], 0);
}

TEST_P(LodScenes, RecordsNameTheWalkThatTheyAreComparedWith) {
    const Record &full = lodCell(GetParam(), "lod-full"), &other = lodCell(GetParam(), "lod-switch");
    ASSERT_TRUE(full.reference && other.reference);
    EXPECT_EQ(other.reference->oracle, "lod-full");
    EXPECT_EQ(other.reference->key.size(), 32U);
    EXPECT_EQ(other.reference->key, full.reference->key);
    EXPECT_EQ(other.reference->content.size(), 32U);
    EXPECT_EQ(other.reference->content, full.reference->content);
}

/// All passes of these techniques draw the screen. Fragments are counted in blocks of 4 × 4, of which fewer are cut by edges
/// on a larger image.
TEST_P(LodScenes, PassesGrowWithTheImage) {
    const Record& record = lodCell(GetParam(), "lod-frame-sequential");
    const OtherScreen other = walkIn(GetParam()).otherScreen("lod-frame-sequential");
    EXPECT_EQ(other.width, 1024);
    ASSERT_EQ(other.passes.size(), record.passes.size());
    EXPECT_EQ(other.passes[0].vertices, record.passes[0].vertices) << "another turn of the levels that are drawn in turn";
    for (std::size_t i = 0; i < other.passes.size(); ++i) {
        const PassRecord &small = record.passes[i], &large = other.passes[i];
        EXPECT_EQ(large.name, small.name);
        EXPECT_EQ(large.draws, small.draws) << small.name;
        EXPECT_LE(large.fragments, 16 * small.fragments) << small.name;
        EXPECT_GE(large.fragments, 8 * small.fragments) << small.name;
    }
}

/// K19, replayed without drawing: triangles of the levels that instances show, those in transition at one of their two
/// levels, in turn; odd instances the other way round than even ones. An instance that begins its transition shows the level
/// that is wholly visible then (dissertation 5.1.2), but in the first frame, which fills both buffers, one with each level.
std::vector<double> trianglesOfFrameSequentialWalk(const Scene& scene) {
    std::map<std::uint32_t, int> shown; // the finer level of each instance in transition
    std::vector<double> triangles;
    const double aspect = static_cast<double>(scene.size.x) / scene.size.y;
    for (int frame = 0; frame < scene.lod->frames; ++frame) {
        std::map<std::uint32_t, int> now;
        double sum = 0;
        for (const techniques::LodInstance& instance : lod::walkFrame(scene, frame, aspect).instances) {
            const std::vector<Level>& levels = scene.objects[instance.chain].levels;
            auto [level, progress] = instance.selection;
            if (progress > 0) {
                const auto before = shown.find(instance.id);
                const bool inTurn = frame == 0 || (before != shown.end() && before->second == level);
                now[instance.id] = level;
                if (inTurn ? (instance.id + static_cast<unsigned>(frame)) % 2 == 1 : progress >= 0.5) ++level;
            }
            sum += static_cast<double>(levels[static_cast<std::size_t>(level)].mesh->triangles.size());
        }
        shown = std::move(now);
        triangles.push_back(sum);
    }
    return triangles;
}

TEST_P(LodScenes, PrimitivesOfAFrameSequentialWalkChangeAsItsLevelsDo) {
    const std::vector<double> triangles = trianglesOfFrameSequentialWalk(loadScene(GetParam(), Profile::Gate));
    const Record& record = lodCell(GetParam(), "lod-frame-sequential");
    const std::vector<double>& drawn = record.values.list("lod.by_frame.primitives");
    ASSERT_EQ(drawn.size(), triangles.size());
    double largest = 0;
    for (std::size_t i = 2; i < triangles.size(); ++i) { // the first frame fills both buffers
        EXPECT_NEAR(drawn[i], triangles[i], 0.01 * triangles[i]) << i;
        largest = std::max(largest, std::abs(triangles[i] - triangles[i - 1]) / triangles[i - 1]);
    }
    EXPECT_NEAR(*record.values["lod.primitive_change"], largest, 0.05 * largest);
}

TEST_P(LodScenes, SeveralInstancesAreInTransitionAtOnceAndLevelsSaveTriangles) {
    const metrics::Values &full = scores(GetParam(), "lod-full"), &switching = scores(GetParam(), "lod-switch"),
                          &blend = scores(GetParam(), "lod-blend"), &sequential = scores(GetParam(), "lod-frame-sequential");
    EXPECT_GE(*switching["lod.transitions"], 4U);
    EXPECT_LT(*switching["lod.primitives"], 0.5 * *full["lod.primitives"]);
    EXPECT_GT(*blend["lod.primitives"], 1.15 * *switching["lod.primitives"]); // both levels in every frame
    // One level a frame; the average of the two is not quite switching's.
    EXPECT_NEAR(*sequential["lod.primitives"], *switching["lod.primitives"], 0.1 * *switching["lod.primitives"]);
}

TEST_P(LodScenes, FrameSequentialTransitionsPopAtMostAFifthOfSwitching) { // claim K20
    const metrics::Values &switching = scores(GetParam(), "lod-switch"),
                          &sequential = scores(GetParam(), "lod-frame-sequential");
    EXPECT_GT(*switching["lod.pop"], 0.001);
    EXPECT_LE(*sequential["lod.pop"], 0.2 * *switching["lod.pop"]);
    EXPECT_LE(*sequential["lod.changed_region"], 0.2 * *switching["lod.changed_region"]);
}

TEST_P(LodScenes, BlendingDependsOnTheOrderOfPolygonsAndTheOthersDoNot) { // claim of dissertation 5.2 on TREES
    // What is left for the others are pixels where two surfaces meet at the same depth, as the bars of a vane do.
    for (const char* variant : {"lod-full", "lod-switch", "lod-frame-sequential"})
        EXPECT_LT(*scores(GetParam(), variant)["lod.order_error"], 0.0025) << variant;
    EXPECT_GT(*scores(GetParam(), "lod-blend")["lod.order_error"], 0.005);
}

INSTANTIATE_TEST_SUITE_P(Gate, LodScenes, testing::Values("simple", "windmills", "trees"),
                         [](const auto& tested) { return tested.param; });

TEST(LodBlendCell, PopsAtMostAFifthOfSwitchingWherePolygonsAreFewOrFlatAndMoreOnUnsortedFoliage) {
    EXPECT_LE(*scores("simple", "lod-blend")["lod.pop"], 0.2 * *scores("simple", "lod-switch")["lod.pop"]);
    EXPECT_LE(*scores("windmills", "lod-blend")["lod.pop"], 0.2 * *scores("windmills", "lod-switch")["lod.pop"]);
    // In the middle of the transition the last leaf drawn gives way to the nearest one, all at once.
    EXPECT_GT(*scores("trees", "lod-blend")["lod.pop"], 0.2 * *scores("trees", "lod-switch")["lod.pop"]);
    EXPECT_LT(*scores("trees", "lod-frame-sequential")["lod.pop"], *scores("trees", "lod-blend")["lod.pop"]);
}

TEST(FrameSequentialCell, NoiseIsLargestWhereSilhouettesDiffer) { // dissertation 5.2: SIMPLE is the worst case
    const auto noise = [](const std::string& scene) {
        return *scores(scene, "lod-frame-sequential")["lod.noise"] - *scores(scene, "lod-switch")["lod.noise"];
    };
    EXPECT_GT(noise("simple"), 2 * noise("windmills"));
    EXPECT_GT(noise("simple"), 2 * noise("trees"));
    EXPECT_GT(noise("trees"), 0);
}

TEST(FrameSequentialCell, WithoutBackProjectionThePictureIsWorseWhereTheCameraMoves) {
    for (const char* scene : {"windmills", "trees"})
        EXPECT_GT(*scores(scene, "lod-frame-sequential:reproject=off")["lod.colour_error"],
                  *scores(scene, "lod-frame-sequential")["lod.colour_error"])
            << scene;
}

TEST(FrameSequentialCell, NeedsTwoBuffersOfEightBytesAPixel) { // claim K21: seven, but 24-bit colour takes 32 here
    const std::uint64_t texture = 64 * 64;
    EXPECT_EQ(lodCell("simple", "lod-frame-sequential").values["cost.work.bytes"], 2U * 8 * 256 * 256 + texture);
    EXPECT_EQ(lodCell("simple", "lod-switch").values["cost.work.bytes"], 0U);
}

} // namespace
} // namespace shadowbench
