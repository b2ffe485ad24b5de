// Shadow-caster levels against exact shadows: a closed form, then the three scenes with levels of detail.
#include "base/error.h"
#include "groundtruth/cgal/hard/exact.h"
#include "scene/load/load.h"
#include "studies/recommend/caster_levels.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace shadowbench::recommend {
namespace {

/// Columns above an eye that looks straight down on 10 m × 10 m of ground, under light that falls straight down: each shades
/// a regular polygon of radius 2 m, and nothing hides it.
Scene columns(const std::string& places, int pixels = 200) {
    return parseScene(
        "title = \"Columns\"\nsize = " + std::to_string(pixels) +
            "\ncamera = { eye = [0, 5, 0], target = [0, 0, 0], up = [0, 0, -1], fovy = 90, near = 0.5, far = 20 }\n"
            "light = { kind = \"directional\", direction = [0, -1, 0] }\n"
            "[[object]]\nmesh = { plane = { half = 9.1 } }\n"
            "[[object]]\nname = \"columns\"\nplace = [" +
            places +
            "]\n"
            "[[object.levels]]\nmesh = { column = { radius = 2, height = 0.5, sides = 64 } }\nuntil = 4\n"
            "[[object.levels]]\nmesh = { column = { radius = 2, height = 0.5, sides = 16 } }\nuntil = 8\n"
            "[[object.levels]]\nmesh = { column = { radius = 2, height = 0.5, sides = 4 } }\n"
            "[tolerance]\nmismatch = 0.01\n",
        "columns.toml", Profile::Gate);
}

/// Area of a regular polygon of radius 2 m as a share of the ground in view.
double share(int sides) { return 0.5 * sides * 4 * std::sin(2 * 3.14159265358979 / sides) / 100; }

/// A shadow's outline of 13 m runs through some 260 pixels of 5 cm, of which a half-covered one is counted or not as its
/// centre lies: the sum of so many is off by less than a tenth of them.
constexpr double pixelNoise = 0.1 * 260 / 40000;

CasterRecommendation recommended(const Scene& scene, const std::vector<std::string>& tolerance = {}) {
    CasterOptions options;
    options.tolerance = tolerance;
    return recommendCasters(scene, options);
}

TEST(CasterLevels, OfAColumnErrByTheAreaThatTheirPolygonLacks) {
    const CasterRecommendation r = recommended(columns("{ at = [0.013, 7, 0.017] }"));
    ASSERT_EQ(r.groups.size(), 1U);
    EXPECT_EQ(r.groups[0].level, 1U);
    EXPECT_NEAR(r.errors.at("mismatch"), share(64) - share(16), pixelNoise);
    ASSERT_TRUE(r.groups[0].coarser);
    EXPECT_NEAR(r.groups[0].coarser->errors.at("mismatch"), share(64) - share(4), pixelNoise);
    EXPECT_EQ(r.errors.at("false_shadow"), 0); // each polygon lies within the finer one
    EXPECT_TRUE(r.verified);
    EXPECT_EQ(r.receiverPixels, 40000U);
}

TEST(CasterLevels, AreTheFinestWhereNoErrorIsAccepted) {
    const CasterRecommendation r = recommended(columns("{ at = [0.013, 7, 0.017] }"), {"0"});
    EXPECT_EQ(r.groups[0].level, 0U);
    EXPECT_EQ(r.triangles, r.finestTriangles);
    EXPECT_EQ(r.errors.at("mismatch"), 0);
    EXPECT_TRUE(r.verified);
}

TEST(CasterLevels, SayWhereTheChainThatWasAskedForEnds) {
    CasterOptions options;
    options.tolerance = {"0.5"};
    options.chains = {{"", {252, 60}}};
    const CasterRecommendation r = recommendCasters(columns("{ at = [0.013, 7, 0.017] }"), options);
    EXPECT_EQ(r.groups[0].level, 1U);
    EXPECT_FALSE(r.groups[0].coarser);
    EXPECT_TRUE(r.verified);
}

TEST(CasterLevels, AreNoneAtAllWhereTheWholeShadowMayBeMissing) {
    const CasterRecommendation r = recommended(columns("{ at = [0.013, 7, 0.017] }"), {"0.5"});
    EXPECT_EQ(r.triangles, 0U);
    EXPECT_NEAR(r.errors.at("mismatch"), share(64), pixelNoise);
    EXPECT_FALSE(r.groups[0].coarser);
    EXPECT_TRUE(r.verified);
}

// Two columns side by side share the tolerance: one may be coarse. Levels of 16 sides err by 0.3 %, of 4 by 4.5 %.
TEST(CasterLevels, OfAllBandsTogetherStayWithinTheTolerance) {
    const CasterRecommendation r = recommended(columns("{ at = [2.3, 7, 0.017] }, { at = [-2.3, 12, 0.017] }"), {"0.05"});
    ASSERT_EQ(r.groups.size(), 2U);
    EXPECT_EQ(r.groups[0].level + r.groups[1].level, 3U);
    EXPECT_NEAR(r.errors.at("mismatch"), 2 * share(64) - share(16) - share(4), 2 * pixelNoise);
    EXPECT_TRUE(r.verified);
}

// One column above the other: the upper one's shadow is hidden in the lower one's. Counted alone, each would need its finest
// level; together one may be left out.
TEST(CasterLevels, OfACasterWhoseShadowAnotherCoversAreNone) {
    const CasterRecommendation r =
        recommended(columns("{ at = [0.013, 7, 0.017] }, { at = [0.013, 12, 0.017] }"), {"0.001"});
    ASSERT_EQ(r.groups.size(), 2U);
    EXPECT_EQ(2 * r.triangles, r.finestTriangles); // one casts nothing
    EXPECT_EQ(r.errors.at("mismatch"), 0);
    EXPECT_TRUE(r.verified);
}

TEST(CasterLevels, NeedAToleranceAndAReceiver) {
    Scene scene = columns("{ at = [0, 7, 0] }");
    scene.tolerance.clear();
    EXPECT_THROW((void)recommended(scene), BadInput);
    EXPECT_NO_THROW((void)recommended(scene, {"0.01"}));
    scene.camera.target = {0, 9, 0}; // away from the ground
    EXPECT_THROW((void)recommended(scene, {"0.01"}), BadInput);
}

// Silhouettes of all of `paper`'s trees at once would take 22 GiB.
TEST(PolygonShadows, OfCastersInPartsAreThoseOfAllAtOnce) {
    const Scene scene = loadScene("windmills", Profile::Gate);
    const Casters casters(scene, 59, ownBands(scene));
    const Receivers ground = receivers(snapshot(scene, 59), scene.size, casters);
    const Snapshot finest = casters.cast(casters.finest());
    const Shadow whole = polygonOracle(ground).shadow(finest);
    for (const std::size_t most : {1U, 5000U}) {
        const Shadow parts = polygonOracle(ground, most).shadow(finest);
        EXPECT_EQ(parts.visibility, whole.visibility) << most;
        EXPECT_EQ(parts.labelled, whole.labelled) << most;
    }
}

/// The recommended levels again, label by label, by shadow rays only.
double mismatchByRays(const Scene& scene, const Chains& chains, const CasterRecommendation& r, const Levels& levels) {
    const Casters casters(withChains(scene, chains), r.frame, ownBands(scene));
    groundtruth::PrimaryHits ground = groundtruth::hard::primaryHits(snapshot(scene, r.frame), scene.size);
    for (std::size_t i = 0; i < ground.id.size(); ++i)
        if (ground.id[i] != 1) ground.surface[i] = groundtruth::Surface::Background; // 1 is the ground's
    groundtruth::Reference fine, coarse;
    groundtruth::hard::labelByRays(casters.cast(casters.finest()), scene.size, ground, fine);
    groundtruth::hard::labelByRays(casters.cast(levels), scene.size, ground, coarse);
    std::size_t wrong = 0, all = 0;
    for (std::size_t i = 0; i < ground.id.size(); ++i) {
        if (ground.surface[i] != groundtruth::Surface::Receiver) continue;
        ++all;
        wrong += fine.visibility[i] != coarse.visibility[i] ? 1 : 0;
    }
    return static_cast<double>(wrong) / static_cast<double>(all);
}

void expectVerified(const CasterRecommendation& r) {
    EXPECT_TRUE(r.verified);
    EXPECT_TRUE(within(r.errors, r.tolerance));
    EXPECT_TRUE(within(r.verifiedErrors, r.tolerance));
    for (const GroupLevel& group : r.groups) {
        ASSERT_TRUE(group.coarser) << group.object << " from " << group.from;
        EXPECT_FALSE(within(group.coarser->errors, r.tolerance)) << group.object << " from " << group.from;
        EXPECT_FALSE(within(group.coarser->verified, r.tolerance)) << group.object << " from " << group.from;
    }
}

Levels levelsOf(const CasterRecommendation& r) {
    Levels levels;
    for (const GroupLevel& group : r.groups) levels.push_back(group.level);
    return levels;
}

/// A scene, levels to choose from (none: its own), and whether a coarser one than the finest is expected to do.
struct Case {
    std::string scene;
    Chains chains;
    bool saves;
};

std::string nameOf(const Case& tested) { return tested.scene + (tested.chains.empty() ? "" : "Simplified"); }

/// A case's scene and what is recommended for it, searched once for all tests.
struct Search {
    explicit Search(const Case& tested) : scene(loadScene(tested.scene, Profile::Gate)) {
        CasterOptions options;
        options.chains = tested.chains;
        result = recommendCasters(scene, options);
    }

    Scene scene;
    CasterRecommendation result;
};

const Search& searched(const Case& tested) {
    static std::map<std::string, Search> known;
    return known.try_emplace(nameOf(tested), tested).first->second;
}

class CasterLevelsOn : public testing::TestWithParam<Case> {};

TEST_P(CasterLevelsOn, HardLightAreWithinToleranceAndNoCoarserOneIs) {
    const auto& [scene, r] = searched(GetParam());
    expectVerified(r);
    EXPECT_EQ(r.oracle, "rays");
    EXPECT_EQ(r.verifier, "polygon");
    EXPECT_EQ(r.errors, r.verifiedErrors); // both oracles are exact
    EXPECT_EQ(r.triangles < r.finestTriangles, GetParam().saves);

    const Levels levels = levelsOf(r);
    EXPECT_LE(mismatchByRays(scene, GetParam().chains, r, levels), 0.005);
    for (std::size_t group = 0; group < levels.size(); ++group) {
        Levels coarser = levels;
        ++coarser[group];
        EXPECT_GT(mismatchByRays(scene, GetParam().chains, r, coarser), 0.005) << r.groups[group].object;
    }
}

// The generator's leaves lie elsewhere at every level: no coarser tree of 600, 300 and 100 triangles will do. One that is
// simplified from the finest will.
INSTANTIATE_TEST_SUITE_P(Gate, CasterLevelsOn,
                         testing::Values(Case{"windmills", {}, true}, Case{"trees", {}, false},
                                         Case{"trees", {{"", {600, 500, 400, 300}}}, true}),
                         [](const auto& tested) { return nameOf(tested.param); });

/// The same casters, but those of `model` as drawn.
Snapshot withOwnShadow(Snapshot casters, const Snapshot& drawn, const std::set<std::uint32_t>& model) {
    const auto own = [&](const Placement& placement) { return model.contains(placement.id); };
    for (Batch& batch : casters.batches) std::erase_if(batch.placements, own);
    for (Batch batch : drawn.batches) {
        std::erase_if(batch.placements, std::not_fn(own));
        if (!batch.placements.empty()) casters.batches.push_back(std::move(batch));
    }
    return casters;
}

/// Surface ids of the instances that stand at the same place, one of each object with levels: the parts of a model.
std::vector<std::set<std::uint32_t>> modelsOf(const Scene& scene) {
    std::vector<std::set<std::uint32_t>> models(scene.objects.back().instances.size());
    std::uint32_t id = 1; // the ground's
    for (std::size_t object = 1; object < scene.objects.size(); ++object)
        for (std::set<std::uint32_t>& model : models) model.insert(++id);
    return models;
}

/// Pixels of models whose labels differ between two choices of the other models' levels.
std::size_t wrongOnModels(const Scene& scene, const Snapshot& fine, const Snapshot& coarse, int frame) {
    const Snapshot drawn = snapshot(scene, frame);
    const groundtruth::PrimaryHits all = groundtruth::hard::primaryHits(drawn, scene.size);
    std::size_t wrong = 0;
    for (const std::set<std::uint32_t>& model : modelsOf(scene)) {
        groundtruth::PrimaryHits own = all;
        for (std::size_t i = 0; i < own.id.size(); ++i)
            if (!model.contains(own.id[i])) own.surface[i] = groundtruth::Surface::Background;
        groundtruth::Reference exact, labels;
        groundtruth::hard::labelByRays(withOwnShadow(fine, drawn, model), scene.size, own, exact);
        groundtruth::hard::labelByRays(withOwnShadow(coarse, drawn, model), scene.size, own, labels);
        for (std::size_t i = 0; i < own.id.size(); ++i) wrong += labels.visibility[i] != exact.visibility[i] ? 1 : 0;
    }
    return wrong;
}

// Why only the ground counts: where it is within tolerance, so are the shadows that models throw on one another.
TEST_P(CasterLevelsOn, HardLightAreRightOnOtherModelsToo) {
    const auto& [scene, r] = searched(GetParam());
    const Casters casters(withChains(scene, GetParam().chains), r.frame, ownBands(scene));
    const std::size_t wrong = wrongOnModels(scene, casters.cast(casters.finest()), casters.cast(levelsOf(r)), r.frame);
    EXPECT_LE(static_cast<double>(wrong), 0.005 * static_cast<double>(r.allReceiverPixels - r.receiverPixels));
}

// A box is no stand-in for a sphere's shadow: by the search's exact fractions and by the verification's 16 points of the
// light it errs by more than six times the tolerance, so that 16 points decide.
TEST(CasterLevelsOnSimple, AreTheSpheresEverywhere) {
    CasterOptions options;
    options.lightSamples = 16;
    const CasterRecommendation r = recommendCasters(loadScene("simple", Profile::Gate), options);
    expectVerified(r);
    EXPECT_EQ(r.triangles, r.finestTriangles);
    EXPECT_EQ(r.oracle, "area");
    for (const GroupLevel& group : r.groups) EXPECT_GT(group.coarser->errors.at("penumbra_rmse"), 6 * 0.05);
}

// Simplified spheres are. From 64 points the verification differs from the exact fraction by 0.003 (measured 0.002).
TEST(CasterLevelsOnSimple, OfSimplifiedSpheresSaveAThirdOrMore) {
    CasterOptions options;
    options.chains = {{"", {500, 320, 180, 80, 20}}};
    const CasterRecommendation r = recommendCasters(loadScene("simple", Profile::Gate), options);
    expectVerified(r);
    EXPECT_LE(3 * r.triangles, 2 * r.finestTriangles);
    EXPECT_NEAR(r.verifiedErrors.at("penumbra_rmse"), r.errors.at("penumbra_rmse"), 0.003);
}

} // namespace
} // namespace shadowbench::recommend
