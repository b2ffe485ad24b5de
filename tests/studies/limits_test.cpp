// Axes, searches and claims at the values up to which they go.
#include "base/error.h"
#include "scene/load/load.h"
#include "studies/claims/claims.h"
#include "studies/recommend/caster_groups.h"
#include "studies/recommend/search.h"
#include "studies/recommend/shadow_error.h"
#include "studies/recommend/shadow_patterns.h"
#include "studies/sweep/axis.h"
#include "studies/sweep/sweep.h"
#include "tests/support/message_of.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

/// Whether the axis takes `value` on the scene.
bool takes(const std::string& scene, const char* axis, double value) {
    Scene moved = loadScene(scene, Profile::Gate);
    try {
        axisNamed(axis).move(moved, value);
    } catch (const BadInput&) {
        return false;
    }
    return true;
}

TEST(Axes, TakeTheirLimitsAndNothingBeyond) {
    EXPECT_TRUE(takes("dueling-frusta", "facing-angle", 0));
    EXPECT_TRUE(takes("sun-in-sky", "sun-size", 180));
    EXPECT_TRUE(takes("simple", "light-size", 0.001));
    EXPECT_TRUE(takes("dueling-frusta", "near-plane", 1e-6));
    for (const double times : {0.0, 1.0}) EXPECT_TRUE(takes("dueling-frusta", "tessellation", times));
    for (const double times : {-1.0, 7.0}) EXPECT_FALSE(takes("dueling-frusta", "tessellation", times));
    EXPECT_TRUE(takes("dueling-frusta", "still-frames", 1));
    EXPECT_FALSE(takes("dueling-frusta", "still-frames", 0));
    for (const double count : {0.0, 16.0}) EXPECT_TRUE(takes("dueling-frusta", "casters", count));
    for (const double count : {-1.0, 16.5}) EXPECT_FALSE(takes("dueling-frusta", "casters", count));
}

TEST(Axes, SetWhatTheyAreNamedAfter) {
    Scene scene = loadScene("dueling-frusta", Profile::Gate);
    axisNamed("near-plane").move(scene, 0.25);
    EXPECT_EQ(scene.camera.near, 0.25);
    axisNamed("still-frames").move(scene, 12);
    EXPECT_EQ(scene.timeline.still, 12);
    axisNamed("tessellation").move(scene, 1);
    EXPECT_EQ(scene.objects[1].levels[0].mesh->triangles.size(), 4 * 12U);
    axisNamed("casters").move(scene, 0);
    EXPECT_EQ(scene.objects.size(), 1U) << "the ground stays";
}

TEST(Axes, OfTheGroundsCasterCountsLeaveItAlone) {
    Scene scene = loadScene("dueling-frusta", Profile::Gate);
    const std::size_t ground = scene.objects[0].instances.size();
    axisNamed("casters").move(scene, 2);
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].instances.size(), ground);
    EXPECT_EQ(scene.objects[1].instances.size(), 2U);
}

TEST(Axes, LeaveTheValuesBelowTheLargestOfTheScene) {
    const Scene scene = loadScene("dueling-frusta", Profile::Gate);
    EXPECT_EQ(axisNamed("casters").valuesFor(scene), (std::vector<double>{1, 2, 4, 8, 16}));
    Axis axis = axisNamed("casters");
    axis.values = {1, 5, 16, 17};
    EXPECT_EQ(axis.valuesFor(scene), (std::vector<double>{1, 5, 16})) << "the largest once";
}

TEST(Axes, RunFromWhatIsEasyToWhatIsHardAndSayHowTheyAreDrawn) {
    for (const Axis& axis : axes()) {
        const bool rises = axis.values.back() > axis.values.front();
        for (std::size_t i = 1; i < axis.values.size(); ++i)
            EXPECT_EQ(axis.values[i] > axis.values[i - 1], rises) << axis.id << " " << axis.values[i];
        const double least = std::ranges::min(axis.values);
        if (axis.whole) {
            EXPECT_TRUE(std::ranges::all_of(axis.values, [](double v) { return v == std::floor(v); })) << axis.id;
        }
        EXPECT_TRUE(axis.logarithmic || least >= 0) << axis.id;
        EXPECT_EQ(axis.isParameter(), !axis.move) << axis.id << ": of scenes, or of techniques";
    }
}

TEST(Axes, ATurnedCameraRunsThroughThirtyFramesAtItsPlace) {
    Scene scene = loadScene("dueling-frusta", Profile::Gate);
    axisNamed("turn").move(scene, 30);
    ASSERT_EQ(scene.target.keys.size(), 31U);
    EXPECT_EQ(scene.timeline.approach, 30);
    EXPECT_EQ(scene.target.keys.front().frame, -30);
    EXPECT_EQ(scene.target.keys.back().frame, 0);
    EXPECT_LT(glm::distance(scene.target.keys.back().value, scene.camera.target), 1e-12);
}

TEST(Sweep, ABreakPointIsOfTheFirstToleranceAndOfScoredRecordsAlone) {
    Record record = test::hardRecord();
    record.sweep = SweepStep{"near-plane", "m", "sm-psm", 4, {}};
    record.tolerances = {{"leak", 0.5}, {"mismatch", 0.25}};
    record.values["accuracy.leak"] = 0.5;
    record.values["accuracy.mismatch"] = 1;
    EXPECT_FALSE(breakPoint({record})) << "at its tolerance, and the second is not asked";
    record.values["accuracy.leak"] = 0.75;
    EXPECT_EQ(breakPoint({record}), 4);
    record.status = Status::ExpectedFailure;
    EXPECT_FALSE(breakPoint({record}));
    record.status = Status::Scored;
    record.tolerances.clear();
    EXPECT_FALSE(breakPoint({record}));
}

std::string claimWith(const std::string& check) {
    return R"([{"id": "K0", "says": "s", "where": "w", "checks": [)" + check + "]}]";
}

std::string refusalOf(const std::string& check) {
    return test::messageOf<BadInput>([&] { (void)parseClaims(claimWith(check)); });
}

const std::string left = R"("left": {"scene": "x", "variant": "a", "metric": "m"})";

TEST(Claims, RefuseChecksThatSayTooMuchOrTooLittle) {
    EXPECT_EQ(refusalOf("{\"says\": \"s\", " + left + R"(, "is": "at most"})"),
              "reading claims: K0: a check has either \"right\" or \"bound\"");
    EXPECT_EQ(refusalOf("{\"says\": \"s\", " + left + R"(, "is": "at most", "bound": 1, "right": {}})"),
              "reading claims: K0: a check has either \"right\" or \"bound\"");
    EXPECT_EQ(refusalOf(R"({"says": "s", "left": 1, "is": "at most", "bound": 1})"),
              "reading claims: K0: an object is expected, not 1");
    EXPECT_EQ(refusalOf(R"({"says": "s", "left": {"scene": "x", "variant": "a", "metric": "m", "value": 1}, )"
                        R"("is": "at most", "bound": 1})"),
              "reading claims: K0: \"axis\" and \"value\" go together");
    for (const char* key : {"variant", "metric"}) {
        nlohmann::json place{{"scene", "x"}, {"variant", "a"}, {"metric", "m"}};
        place.erase(key);
        EXPECT_EQ(refusalOf(R"({"says": "s", "is": "at most", "bound": 1, "left": )" + place.dump() + "}"),
                  fmt::format("reading claims: K0: \"{}\" is missing", key));
    }
    const std::string grows = R"({"says": "s", "left": {"scene": "x", "variant": "a", "metric": "m", "axis": "n"}, )";
    EXPECT_EQ(refusalOf(grows + R"("grows over": [1, "2"]})"), "reading claims: K0: \"grows over\" must list numbers");
    EXPECT_EQ(refusalOf(grows + R"("grows over": 1})"),
              "reading claims: K0: \"grows over\" must list two values of the axis or more");
    EXPECT_EQ(refusalOf(grows + R"("grows over": [1, 2]})"), "");
    EXPECT_EQ(refusalOf("{\"says\": \"s\", " + left + R"(, "grows over": [1, 2]})"),
              "reading claims: K0: \"axis\" is missing");
    EXPECT_EQ(refusalOf(R"({"says": "s", "left": {"scene": "x"}, "published": {"a": 1, "b": 2}, )"
                        R"("rank correlation at least": 1})"),
              "reading claims: K0: \"metric\" is missing");
}

TEST(Claims, AskAThousandCasesOfOneCheckAtMost) {
    const auto listed = [](std::size_t scenes) {
        return R"({"says": "s", "left": {"variant": "a", "metric": "m", "scene": )" +
               nlohmann::json(std::vector<std::string>(scenes, "x")).dump() + R"(}, "is": "at most", "bound": 1})";
    };
    EXPECT_EQ(parseClaims(claimWith(listed(1000)))[0].checks[0].cases.size(), 1000U);
}

TEST(Claims, ReadFactorsAndBounds) {
    const auto factorOf = [](const std::string& rest) {
        return parseClaims(claimWith("{\"says\": \"s\", " + left + ", " + rest + "}"))[0].checks[0];
    };
    EXPECT_EQ(factorOf(R"("is": "at most", "right": {"variant": "b"})").factor, 1);
    EXPECT_EQ(factorOf(R"("is": "at most", "right": {"variant": "b"}, "times": 3)").factor, 3);
    const Check least = factorOf(R"("is": "at least", "bound": 0.25)");
    EXPECT_EQ(least.factor, 0.25);
    EXPECT_FALSE(least.atMost);
    EXPECT_FALSE(least.cases[0].right);
}

/// Samples of one case with these margins.
std::vector<Sample> samples(const std::vector<double>& margins) {
    std::vector<Sample> result;
    for (const double margin : margins) result.push_back({margin, {}, margin, margin >= 0});
    return result;
}

TEST(Outcomes, HoldUpToTheBoundItself) {
    EXPECT_EQ(outcomeOf(samples({0})), Outcome::Yes);
    EXPECT_EQ(outcomeOf(samples({0, 0, 0})), Outcome::Yes);
    EXPECT_EQ(outcomeOf(samples({-1e-300})), Outcome::No);
    EXPECT_EQ(outcomeOf(samples({HUGE_VAL, 1})), Outcome::Yes) << "a quotient by 0 has no mean";
    std::vector<Sample> some = samples({1, 1});
    some[1].holds.reset();
    EXPECT_EQ(outcomeOf(some), Outcome::NotMeasured);
    some = samples({1, 1});
    some[0].margin.reset(); // it only holds
    EXPECT_EQ(outcomeOf(some), Outcome::Yes);
    some[1].holds = false;
    EXPECT_EQ(outcomeOf(some), Outcome::NotToldApart);
    some[0].holds = false;
    EXPECT_EQ(outcomeOf(some), Outcome::No);
}

TEST(Claims, OfCasesThatCannotBeToldApartTheVerdictIsThat) {
    const auto record = [](const char* variant, double mismatch, std::uint32_t seed) {
        Record r = test::hardRecord();
        r.variant = variant;
        r.seed = seed;
        r.values["accuracy.mismatch"] = mismatch;
        return r;
    };
    const auto check = [](const char* variant) {
        return fmt::format(R"({{"says": "s", "left": {{"scene": "dueling-frusta", "variant": "{}", )"
                           R"("metric": "accuracy.mismatch"}}, "is": "at most", "bound": 0.5}})",
                           variant);
    };
    const std::vector<Record> records{record("a", 0.25, 1), record("a", 0.75, 2), record("b", 0.75, 1)};
    const auto verdict = [&](const std::string& checks) {
        const std::vector<Claim> parsed = parseClaims(claimWith(checks));
        return judge(parsed.front(), records).verdict;
    };
    EXPECT_EQ(verdict(check("a")), Verdict::NotToldApart);
    EXPECT_EQ(verdict(check("a") + "," + check("b")), Verdict::NotReproduced) << "one fails and none holds";
}

TEST(Claims, AFigureIsReadUpToTheLastFrame) {
    Record record = test::hardRecord();
    record.values.list("stability.by_frame.rmse") = {0.5, 0.125};
    const auto at = [&](const char* metric) {
        return lookUp({.scene = record.scene,
                       .variant = record.variant,
                       .profile = "",
                       .metric = metric,
                       .axis = "",
                       .value = {},
                       .over = {},
                       .settles = {}},
                      {record});
    };
    EXPECT_EQ(at("stability.by_frame.rmse[1]"), 0.5);
    EXPECT_EQ(at("stability.by_frame.rmse[2]"), 0.125);
    EXPECT_FALSE(at("stability.by_frame.rmse[3]"));
    EXPECT_FALSE(at("stability.by_frame.none"));
    EXPECT_FALSE(at("stability.by_frame.rmse.deeper"));
}

TEST(RankCorrelation, OfRanksWithTiesOnBothSides) {
    EXPECT_NEAR(*rankCorrelation({1, 1, 2, 3}, {1, 2, 2, 3}), 0.833333, 1e-6); // 1½ 1½ 3 4 and 1 2½ 2½ 4
    EXPECT_FALSE(rankCorrelation({1, 2}, {7, 7}));
}

} // namespace
} // namespace shadowbench

namespace shadowbench::recommend {
namespace {

TEST(CheapestAdequate, OfEqualCostsTakesTheFirstAndCountsWhatItTried) {
    const Costs costs{{3, 1}, {3, 1}};
    const auto choice = cheapestAdequate(costs, [](const Levels& levels) { return levels != Levels{1, 1}; });
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->levels, (Levels{0, 1}));
    EXPECT_EQ(choice->tried, 2U);
    EXPECT_EQ(choice->possible, 4U);
    EXPECT_EQ(totalCost({{5, 2}, {7, 3}, {11, 1}}, {1, 0, 1}), 10U);
}

TEST(CheapestAdequate, SearchesAsManyChoicesAsItSays) {
    const Costs most(22, std::vector<std::size_t>{1, 2});
    EXPECT_EQ(cheapestAdequate(most, [](const Levels&) { return true; })->possible, mostChoices);
    EXPECT_THROW((void)cheapestAdequate(Costs(23, {1, 2}), [](const Levels&) { return true; }), BadInput);
}

TEST(HardErrors, OfNoPixelsAreAbsent) {
    LabelErrors labels;
    EXPECT_TRUE(hardErrors(labels).empty());
    labels.add(true, false, 3);
    labels.add(false, false, 5);
    EXPECT_EQ(hardErrors(labels), (Errors{{"mismatch", 3.0 / 8}, {"false_shadow", 3.0 / 8}}));
    labels.add(false, true, 8);
    EXPECT_EQ(hardErrors(labels), (Errors{{"mismatch", 11.0 / 16}, {"false_shadow", 3.0 / 8}, {"leak", 1}}));
}

TEST(HardErrors, CountPixelsThatBothShadowsLabel) {
    const auto shadow = [](const std::vector<float>& visibility, const std::vector<std::uint8_t>& labelled) {
        Shadow result{Image<float>(4, 1), Image<std::uint8_t>(4, 1)};
        for (std::size_t i = 0; i < 4; ++i) {
            result.visibility[i] = visibility[i];
            result.labelled[i] = labelled[i];
        }
        return result;
    };
    const Errors errors = hardErrors(shadow({0, 1, 0, 1}, {1, 1, 0, 1}), shadow({1, 1, 1, 0}, {1, 1, 1, 0}));
    EXPECT_EQ(errors, (Errors{{"mismatch", 0.5}, {"false_shadow", 0.5}}));
}

TEST(Tolerance, TakesNothingAndRefusesWhatIsNoNumber) {
    const Light hard = loadScene("windmills", Profile::Gate).light;
    EXPECT_EQ(parseTolerance({"0"}, hard).at("mismatch"), 0);
    EXPECT_TRUE(parseTolerance({"leak=1"}, hard).contains("leak"));
    for (const char* text : {"nan", "0.1x", "leak=", "", "leak=-1"})
        EXPECT_THROW((void)parseTolerance({text}, hard), BadInput) << text;
    EXPECT_EQ(test::messageOf<BadInput>([&] { (void)parseTolerance({"leek=1"}, hard); }),
              "shadows of this light are not measured by \"leek\" (did you mean \"leak\"?); they are by mismatch, "
              "false_shadow, leak");
}

TEST(Tolerance, OfTheSceneIsThatOfItsLight) {
    Scene scene = loadScene("windmills", Profile::Gate);
    scene.tolerance = {{"leak", 0.25}, {"rmse", 0.5}};
    EXPECT_EQ(ownTolerance(scene), (Errors{{"leak", 0.25}}));
}

TEST(Casters, StandInTheBandThatTheirDistanceEnds) {
    const Scene scene = loadScene("windmills", Profile::Gate);
    const Casters all(scene, 59, {});
    ASSERT_EQ(all.groups().size(), 2U) << "one band of each object";
    EXPECT_EQ(all.groups()[0].from, 0);
    EXPECT_TRUE(std::isinf(all.groups()[0].until));
    const glm::dvec3 eye = snapshot(scene, 59).camera.eye;
    const auto distanceOf = [&](const Placement& p) { return glm::distance(eye, glm::dvec3(p.world[3])); };
    const Placement& first = *std::ranges::min_element(all.groups()[0].placements, {}, distanceOf);
    const double distance = distanceOf(first);
    const Casters split(scene, 59, {distance});
    const auto& near = split.groups()[0].placements;
    EXPECT_TRUE(std::ranges::any_of(near, [&](const Placement& p) { return p.id == first.id; })) << "(from, until]";
    EXPECT_EQ(split.groups()[0].until, distance);
    EXPECT_EQ(split.groups()[1].from, distance);
    EXPECT_THROW(Casters(scene, 59, {7, 7}), BadInput);
    EXPECT_EQ(all.costs()[0][0], all.groups()[0].levels[0]->triangles.size() * all.groups()[0].placements.size());
}

TEST(Chains, AreOfFallingNumbersDownToATetrahedron) {
    const Scene simple = loadScene("simple", Profile::Gate);
    EXPECT_THROW(withChains(simple, {{"", {500, 3}}}), BadInput);
    EXPECT_THROW(withChains(simple, {{"", {500, 500}}}), BadInput);
    const std::size_t whole = simple.objects[1].levels[0].mesh->triangles.size();
    const auto levels = withChains(simple, {{"", {static_cast<int>(whole), 100}}}).objects[1].levels;
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0].mesh, simple.objects[1].levels[0].mesh);
    EXPECT_EQ(levels[0].until, 1);
    EXPECT_TRUE(std::isinf(levels[1].until));
}

} // namespace
} // namespace shadowbench::recommend
