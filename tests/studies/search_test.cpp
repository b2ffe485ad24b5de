// The choice of levels on errors made up for it, and the parts that a recommendation is put together from.
#include "base/error.h"
#include "scene/load/load.h"
#include "studies/recommend/caster_groups.h"
#include "studies/recommend/search.h"
#include "studies/recommend/shadow_error.h"
#include "studies/recommend/shadow_patterns.h"

#include <gtest/gtest.h>

namespace shadowbench::recommend {
namespace {

const Costs threeLevels{{600, 200, 60}, {600, 200, 60}};

/// Errors that add up, as those of shadows that do not overlap.
double sum(const Levels& levels) { return 1.0 * static_cast<double>(levels[0]) + 2.5 * static_cast<double>(levels[1]); }

TEST(CheapestAdequate, TakesTheFewestTrianglesWithinTheBound) {
    const auto choice = cheapestAdequate(threeLevels, [](const Levels& levels) { return sum(levels) <= 3; });
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->levels, (Levels{2, 0})); // 660 triangles at 2; (0, 1) takes 800, (1, 1) errs by 3.5
    EXPECT_EQ(choice->possible, 9U);
}

TEST(CheapestAdequate, FailsOneLevelCoarserWhateverTheBound) {
    for (double bound = 0; bound < 7; bound += 0.25) {
        const auto within = [&](const Levels& levels) { return sum(levels) <= bound; };
        const auto choice = cheapestAdequate(threeLevels, within);
        ASSERT_TRUE(choice);
        for (std::size_t group = 0; group < 2; ++group) {
            Levels coarser = choice->levels;
            if (++coarser[group] < 3) {
                EXPECT_FALSE(within(coarser)) << "bound " << bound << ", group " << group;
            }
        }
    }
}

// Both coarse levels err the same way where the shadows overlap: alone each is wrong, together they are right.
TEST(CheapestAdequate, FindsErrorsThatCancel) {
    const auto cancelling = [](const Levels& levels) { return levels[0] == levels[1]; };
    EXPECT_EQ(cheapestAdequate(threeLevels, cancelling)->levels, (Levels{2, 2}));
}

// One shadow covers the other: either may be coarse, not both. A budget for each group would allow neither or both.
TEST(CheapestAdequate, MayCoarsenOneOfTwoThatCoverEachOther) {
    const Costs costs{{600, 60}, {900, 60}};
    const auto covered = [](const Levels& levels) { return levels[0] == 0 || levels[1] == 0; };
    EXPECT_EQ(cheapestAdequate(costs, covered)->levels, (Levels{0, 1}));
}

TEST(CheapestAdequate, JudgesNothingTwiceAndNothingAfterTheAnswer) {
    std::size_t judged = 0;
    const auto choice = cheapestAdequate(threeLevels, [&](const Levels& levels) {
        ++judged;
        return totalCost(threeLevels, levels) >= 400;
    });
    EXPECT_EQ(choice->levels, (Levels{1, 1}));
    EXPECT_EQ(judged, choice->tried);
    EXPECT_EQ(judged, 4U); // 120, 260, 260, 400
    EXPECT_FALSE(cheapestAdequate(threeLevels, [](const Levels&) { return false; }));
}

TEST(CheapestAdequate, RefusesToSearchForEver) {
    const Costs costs(12, std::vector<std::size_t>{4, 3, 2, 1});
    EXPECT_THROW((void)cheapestAdequate(costs, [](const Levels&) { return true; }), BadInput);
}

TEST(ShadowPatterns, CountTheUnionOfShadows) {
    // Casters 0 and 1 are exact; 2 is caster 1 at a coarser level.
    const ShadowPatterns patterns({0, 0, 0, 0b001, 0b011, 0b011, 0b010, 0b010, 0b110, 0b100});
    const LabelErrors errors = patterns.compare(0b101, 0b011);
    EXPECT_EQ(errors.lit, 4U);
    EXPECT_EQ(errors.shadowed, 6U);
    EXPECT_EQ(errors.falseShadow, 1U); // 0b100
    EXPECT_EQ(errors.leak, 2U);        // 0b010 twice; where caster 0 stands before it, nothing is missed
    const Errors shares = hardErrors(errors);
    EXPECT_DOUBLE_EQ(shares.at("mismatch"), 3.0 / 10);
    EXPECT_DOUBLE_EQ(shares.at("false_shadow"), 1.0 / 4);
    EXPECT_DOUBLE_EQ(shares.at("leak"), 2.0 / 6);
}

TEST(Tolerance, HoldsForEveryMetricThatWasMeasured) {
    const Errors errors{{"mismatch", 0.01}, {"leak", 0.2}};
    EXPECT_TRUE(within(errors, {{"mismatch", 0.01}}));
    EXPECT_FALSE(within(errors, {{"mismatch", 0.01}, {"leak", 0.1}}));
    EXPECT_TRUE(within({}, {{"leak", 0.1}})); // nothing was in shadow
}

TEST(Tolerance, IsReadFromWordsAndFromTheScene) {
    const Scene windmills = loadScene("windmills", Profile::Gate), simple = loadScene("simple", Profile::Gate);
    EXPECT_TRUE(parseTolerance({"0.01"}, windmills.light).contains("mismatch"));
    EXPECT_TRUE(parseTolerance({"0.01"}, simple.light).contains("penumbra_rmse"));
    EXPECT_EQ(parseTolerance({"leak=0.1"}, windmills.light).at("leak"), 0.1);
    EXPECT_THROW((void)parseTolerance({"rmse=0.1"}, windmills.light), BadInput);
    EXPECT_THROW((void)parseTolerance({"mismatch=much"}, windmills.light), BadInput);
    EXPECT_THROW((void)parseTolerance({"-0.1"}, windmills.light), BadInput);
    EXPECT_EQ(ownTolerance(windmills).size(), 1U);
    EXPECT_EQ(ownTolerance(simple).size(), 2U);
}

TEST(Casters, AreGroupedByObjectAndDistance) {
    const Scene scene = loadScene("windmills", Profile::Gate);
    EXPECT_EQ(ownBands(scene), (std::vector<double>{16, 26}));
    const Casters casters(scene, 59, ownBands(scene));
    ASSERT_EQ(casters.groups().size(), 6U);
    std::size_t towers = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(casters.groups()[i].object, "towers");
        towers += casters.groups()[i].placements.size();
    }
    EXPECT_EQ(towers, scene.objects[1].instances.size());
    EXPECT_FALSE(casters.hasLevels(1)); // the ground
    EXPECT_TRUE(casters.hasLevels(2));
}

// The scene draws by the same bands: casting what is drawn is one of the choices.
TEST(Casters, CastWhatIsDrawnWhenTheirLevelsAreTheDrawnOnes) {
    const Scene scene = loadScene("windmills", Profile::Gate);
    const Casters casters(scene, 59, ownBands(scene));
    EXPECT_EQ(casters.cast({0, 1, 2, 0, 1, 2}).triangles(), snapshot(scene, 59).triangles());
    const std::size_t ground = 12;
    EXPECT_EQ(casters.castAlone(3, 1).triangles(), ground + 200 * casters.groups()[3].placements.size());
}

TEST(Casters, OfASceneWithoutLevelsAreAnError) {
    EXPECT_THROW(Casters(loadScene("dueling-frusta", Profile::Gate), 0, {}), BadInput);
    EXPECT_THROW(Casters(loadScene("trees", Profile::Gate), 0, {9, 7}), BadInput);
}

TEST(Chains, GoOnDownToNoCasterAtAll) {
    const Scene windmills = loadScene("windmills", Profile::Gate);
    const auto triangles = [&](const Chains& chains) {
        const Scene scene = withChains(windmills, chains);
        std::vector<std::vector<std::size_t>> all;
        for (std::size_t i = 1; i < 3; ++i) {
            all.emplace_back();
            for (const Level& level : scene.objects[i].levels) all.back().push_back(level.mesh->triangles.size());
        }
        return all;
    };
    const auto longer = triangles({});
    EXPECT_GT(longer[0].size(), windmills.objects[1].levels.size());
    EXPECT_EQ(longer[0].back(), 0U);
    EXPECT_TRUE(std::ranges::is_sorted(longer[0], std::greater<>()));
    EXPECT_EQ(triangles({{"rotors", {600, 300}}})[1], (std::vector<std::size_t>{600, 300})); // as asked for
}

TEST(Chains, ReplaceTheLevelsOfAnObject) {
    const Scene simple = loadScene("simple", Profile::Gate);
    const std::vector<Level> levels = withChains(simple, {{"", {500, 180, 80}}}).objects[1].levels;
    ASSERT_EQ(levels.size(), 3U);
    EXPECT_EQ(levels[0].mesh, simple.objects[1].levels[0].mesh);
    EXPECT_EQ(levels[1].mesh->triangles.size(), 180U);
    EXPECT_EQ(levels[2].mesh->triangles.size(), 80U);

    const Scene windmills = loadScene("windmills", Profile::Gate);
    EXPECT_EQ(withChains(windmills, {{"rotors", {600, 300}}}).objects[2].levels.size(), 2U);
    EXPECT_THROW(withChains(windmills, {{"", {600, 300}}}), BadInput); // two objects have levels
    EXPECT_THROW(withChains(windmills, {{"rotor", {600, 300}}}), BadInput);
    EXPECT_THROW(withChains(simple, {{"", {80, 500}}}), BadInput);
    EXPECT_THROW(withChains(simple, {{"", {500}}}), BadInput);
}

} // namespace
} // namespace shadowbench::recommend
