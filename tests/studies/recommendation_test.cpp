// What is recommended: answers from records, their text and JSON, and casters over a plane of which every shadow is known.
#include "base/error.h"
#include "base/files.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "studies/recommend/caster_levels.h"
#include "studies/recommend/hard_choices.h"
#include "studies/recommend/recommendation.h"
#include "studies/recommend/recommendation_text.h"
#include "tests/support/message_of.h"
#include "tests/support/records_examples.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <tuple>

namespace shadowbench::recommend {
namespace {

using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Every figure is another one.
Recommendation answered() {
    CasterRecommendation casters;
    casters.scene = "yard";
    casters.profile = "gate";
    casters.frame = 59;
    casters.size = {64, 48};
    casters.tolerance = {{"mismatch", 0.005}};
    casters.receiverPixels = 1500;
    casters.allReceiverPixels = 2000;
    casters.groups = {{"tree", 0, 12.5, 3, {400, 100, 25}, 1, CoarserLevel{2, {{"mismatch", 0.011}}, {{"mismatch", 0.012}}}},
                      {"tree", 12.5, infinity, 2, {400, 100, 25}, 2, {}},
                      {"post", 0, infinity, 4, {60, 0}, 1, {}}};
    casters.triangles = 350;
    casters.finestTriangles = 2240;
    casters.drawnTriangles = 1120;
    casters.errors = {{"mismatch", 0.004}, {"leak", 0.3}};
    casters.drawnErrors = {{"mismatch", 0.006}};
    casters.oracle = "rays";
    casters.tried = 7;
    casters.possible = 18;
    casters.verifier = "polygon";
    casters.verifiedErrors = {{"mismatch", 0.0045}};
    casters.verified = true;

    Recommendation result;
    result.scene = "yard";
    result.questions = {Question::Casters, Question::Technique, Question::Map, Question::Samples};
    result.casters = casters;
    result.tolerances = {{"mismatch", 0.005}, {"edge_error.p95", 1.5}};
    result.technique = Cheapest{"sm-tiled", 0.0031, 2.25, true};
    result.maps = {{"sm-uniform:map=2048", 2048, 0.0025}, {"sm-lispsm:map=4096", 4096, 0.002}};
    return result;
}

TEST(RecommendationText, HasEveryAnswer) {
    EXPECT_EQ(
        text(answered()),
        " scene: yard\n"
        " coarsest shadow casters within mismatch 0.5 % of their finest levels · gate · frame 59\n"
        " casters      distance   instances       levels   cast at   triangles   one level coarser\n"
        " tree      0 to 12.5 m           3   400 100 25       100         300      mismatch 1.2 %\n"
        " tree      from 12.5 m           2   400 100 25        25          50   none in the chain\n"
        " post              all           4         60 0         0           0       there is none\n"
        " triangles: 350 of 2240, 84 % saved, at mismatch 0.4 % (rays; 7 of 18 choices judged)\n"
        " cast at the levels that are drawn: 1120 triangles, 50 % saved, at mismatch 0.6 %: above tolerance\n"
        " verified by polygon: at these levels mismatch 0.45 %, with any one group a level coarser above tolerance; 1 of 3 "
        "groups cast at the end of their chain, and nothing says that a coarser level would not do: give more with "
        "--levels\n"
        " counted on objects without levels: 1500 of 2000 receiver pixels\n"
        " cheapest technique within mismatch 0.5 %, edge_error.p95 1.5: sm-tiled, at 0.31 % and 2.25 frames of "
        "sm-uniform, the dearer of standing and in motion\n"
        " smallest map within mismatch 0.5 %, edge_error.p95 1.5\n"
        " technique             texels a side    error\n"
        " sm-uniform:map=2048            2048   0.25 %\n"
        " sm-lispsm:map=4096             4096    0.2 %\n"
        " fewest samples within mismatch 0.5 %, edge_error.p95 1.5: no technique that was tried has one\n");
}

TEST(RecommendationText, SaysWhatIsNotSo) {
    Recommendation unlike = answered();
    unlike.questions = {Question::Casters, Question::Technique};
    unlike.casters->verified = false;
    unlike.casters->drawnErrors["mismatch"] = 0.005;
    unlike.casters->groups = {unlike.casters->groups.front()};
    unlike.technique->moving = false;
    std::string shown = text(unlike);
    EXPECT_NE(shown.find("\n NOT VERIFIED by polygon: at these levels mismatch 0.45 %\n"), std::string::npos) << shown;
    EXPECT_NE(shown.find("at mismatch 0.5 %: within tolerance\n"), std::string::npos) << shown;
    EXPECT_NE(shown.find("frames of sm-uniform, standing\n"), std::string::npos) << shown;
    EXPECT_EQ(shown.find("texels"), std::string::npos) << shown;
    EXPECT_EQ(shown.find("samples"), std::string::npos) << shown;

    unlike.casters.reset();
    unlike.technique.reset();
    EXPECT_EQ(text(unlike), " scene: yard\n cheapest technique within mismatch 0.5 %, edge_error.p95 1.5: none\n");
}

TEST(RecommendationJson, HasEveryAnswer) {
    Recommendation one = answered();
    one.samples = {{"pcss:taps=32+32", 64, 0.001}};
    EXPECT_EQ(json::parse(recommend::json({.scenes = {one}})), json::parse(R"([{
        "scene": "yard",
        "casters": {
            "profile": "gate", "frame": 59, "size": [64, 48], "tolerance": {"mismatch": 0.005},
            "groups": [
                {"object": "tree", "from": 0.0, "until": 12.5, "instances": 3, "levels": [400, 100, 25], "level": 1,
                 "triangles": 100,
                 "coarser": {"level": 2, "errors": {"mismatch": 0.011}, "verified_errors": {"mismatch": 0.012}}},
                {"object": "tree", "from": 12.5, "instances": 2, "levels": [400, 100, 25], "level": 2, "triangles": 25},
                {"object": "post", "from": 0.0, "instances": 4, "levels": [60, 0], "level": 1, "triangles": 0}],
            "oracle": "rays", "errors": {"mismatch": 0.004, "leak": 0.3}, "all_triangles": 350,
            "finest": {"all_triangles": 2240}, "drawn": {"all_triangles": 1120, "errors": {"mismatch": 0.006}},
            "verifier": "polygon", "verified_errors": {"mismatch": 0.0045}, "verified": true,
            "receiver_pixels": 1500, "all_receiver_pixels": 2000},
        "tolerance": {"mismatch": 0.005, "edge_error.p95": 1.5},
        "technique": {"variant": "sm-tiled", "error": 0.0031, "cost": 2.25, "in_motion": true},
        "map": [{"variant": "sm-uniform:map=2048", "texels": 2048.0, "error": 0.0025},
                {"variant": "sm-lispsm:map=4096", "texels": 4096.0, "error": 0.002}],
        "samples": [{"variant": "pcss:taps=32+32", "samples": 64.0, "error": 0.001}]
    }])"));
    const Recommendations two{.scenes = {one, one}, .common = report::CommonAdvice{"sm-tiled", "yard", 2.25}};
    EXPECT_EQ(json::parse(recommend::json(two)).back(), json::parse(R"({"scenes": ["yard", "yard"],
        "technique": {"variant": "sm-tiled", "cost": 2.25, "dearest_scene": "yard"}})"));
    EXPECT_EQ(commonText(two), " one technique for yard, yard: sm-tiled, at most 2.25 frames of sm-uniform (on yard)\n");
    EXPECT_EQ(json::parse(recommend::json({.scenes = {one, one}})).back().at("technique"), json());
    EXPECT_EQ(commonText({.scenes = {one, one}}),
              " one technique for yard, yard: none is within tolerance on all of them\n");
    EXPECT_EQ(commonText({.scenes = {one}}), "") << "its own line says it";
    one.technique->card = "gtx-1080@1920x1080";
    EXPECT_NE(text(one).find("2.25 ms on gtx-1080 at 1920×1080, modelled, the dearer of standing and in motion"),
              std::string::npos)
        << text(one);
    EXPECT_EQ(json::parse(recommend::json({.scenes = {one}})).at(0).at("technique").at("modelled_on"), "gtx-1080@1920x1080");
    one.questions = {Question::Map};
    one.technique.reset();
    one.casters.reset();
    const json alone = json::parse(recommend::json({.scenes = {one}}))[0];
    EXPECT_FALSE(alone.contains("technique") || alone.contains("casters") || alone.contains("samples"));
}

TEST(Questions, AreNamed) {
    for (const Question question : {Question::Casters, Question::Technique, Question::Map, Question::Samples})
        EXPECT_EQ(questionNamed(std::string(name(question))), question);
    EXPECT_EQ(test::messageOf<BadInput>([] { questionNamed("mapp"); }),
              "there is no question \"mapp\" (did you mean \"map\"?); there are casters, technique, map, samples");
}

/// Plates under a light straight above 10 m × 10 m of ground, which an eye looks straight down on from below them: regular
/// polygons of 16 m² at level 0, 9 m² at level 1 and 1 m² at level 2, whose shadows cover 16 %, 9 % and 1 % of what is seen.
std::string platesText(const std::string& places,
                       const std::string& light = "kind = \"directional\", direction = [0, -1, 0]") {
    std::string levels;
    for (const auto& [sides, area, until] : {std::tuple{16, 16, "\nuntil = 4"}, {8, 9, "\nuntil = 8"}, {4, 1, ""}})
        levels += fmt::format("[[object.levels]]\nmesh = {{ column = {{ radius = {:.6f}, height = 0.2, sides = {} }} }}{}\n",
                              std::sqrt(area / (0.5 * sides * std::sin(2 * std::numbers::pi / sides))), sides, until);
    return "title = \"Plates\"\nsize = 50\n"
           "camera = { eye = [0, 5, 0], target = [0, 0, 0], up = [0, 0, -1], fovy = 90, near = 0.5, far = 20 }\n"
           "light = { " +
           light + " }\n[[object]]\nmesh = { plane = { half = 9.1 } }\n[[object]]\nname = \"plates\"\nplace = [" + places +
           "]\n" + levels + "[tolerance]\nmismatch = 0.09\n";
}

Scene plates(const std::string& text) { return parseScene(text, "plates.toml", Profile::Gate); }

const std::string onePlate = "{ at = [0.013, 9, 0.017] }",
                  twoPlates = "{ at = [2.513, 7, 0.017] }, { at = [-2.487, 12, 0.017] }";

/// Records of a run in a file that goes with it.
class Recorded : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// On dueling-frusta, whose tolerance is that of the record.
    static Record record(const std::string& technique, const std::string& parameter, double mismatch, double cost) {
        Record one = test::hardRecord();
        one.technique = technique;
        one.variant = parameter.empty() ? technique : technique + ":" + parameter;
        if (const std::size_t equals = parameter.find('='); equals != std::string::npos)
            one.parameters = {{parameter.substr(0, equals), parameter.substr(equals + 1)}};
        one.values["accuracy.mismatch"] = mismatch;
        one.values["cost.time.ratio"] = cost;
        one.tolerances = {{"mismatch", 0.005}};
        return one;
    }

    [[nodiscard]] RecommendOptions asked(const std::vector<Record>& records, std::set<Question> questions) const {
        std::string lines;
        for (const Record& one : records) lines += toJson(one) + "\n";
        writeFile(folder_ / "results.jsonl", lines);
        RecommendOptions options;
        options.scenes = {"dueling-frusta"};
        options.questions = std::move(questions);
        options.records = folder_ / "results.jsonl";
        options.quiet = true;
        return options;
    }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / fmt::format("shadowbench_recommendation_{}", getpid());
};

TEST_F(Recorded, TheCheapestWithinToleranceIsNamedAndWhatTheLeastMapIs) {
    RecommendOptions options =
        asked({record("a", "map=512", 0.02, 0.5), record("a", "map=1024", 0.004, 1.5), record("a", "map=2048", 0.001, 2.5)},
              {Question::Technique, Question::Map});
    const Recommendations found = recommend(options);
    EXPECT_EQ(found.code, ExitCode::Pass);
    ASSERT_EQ(found.scenes.size(), 1U);
    const Recommendation& one = found.scenes.front();
    EXPECT_EQ(one.scene, "dueling-frusta");
    ASSERT_TRUE(one.technique);
    EXPECT_EQ(one.technique->variant, "a:map=1024");
    EXPECT_EQ(one.technique->error, 0.004);
    EXPECT_EQ(one.technique->cost, 1.5);
    ASSERT_EQ(one.maps.size(), 1U);
    EXPECT_EQ(one.maps.front().variant, "a:map=1024");
    EXPECT_TRUE(one.samples.empty());
    EXPECT_FALSE(one.casters);
    EXPECT_EQ(report::formatBounds(one.tolerances), "mismatch 0.5 %, leak 5 %, false_shadow 2 %, missing_edges 5 %");

    options.casters.tolerance = {"mismatch=0.002"};
    EXPECT_EQ(recommend(options).scenes.front().technique->variant, "a:map=2048");
    EXPECT_EQ(recommend(options).scenes.front().maps.front().amount, 2048);
    options.casters.tolerance = {"0"};
    EXPECT_FALSE(recommend(options).scenes.front().technique);
}

TEST_F(Recorded, OfASceneWithoutLevelsTheTechniqueIsNamedAndItsMap) {
    const Recommendation mapped =
        recommend(asked({record("sm-uniform", "map=512", 0.004, 1), record("sm-uniform", "map=1024", 0.002, 2)}, {}))
            .scenes.front();
    ASSERT_TRUE(mapped.technique);
    EXPECT_EQ(mapped.technique->variant, "sm-uniform:map=512");
    ASSERT_EQ(mapped.maps.size(), 1U);
    EXPECT_EQ(mapped.maps.front().amount, 512);
    const Recommendation without = recommend(asked({record("volume-zfail", "", 0, 1)}, {})).scenes.front();
    EXPECT_FALSE(without.technique) << "it is not for open meshes";
    EXPECT_FALSE(without.questions.contains(Question::Map)) << "nobody asked for a map";
}

TEST_F(Recorded, NeedsAreTheUsersAndOfASceneThatStandsStillNotThoseOfMotion) {
    RecommendOptions options =
        asked({record("sm-history", "", 0.001, 1), record("volume-zfail", "", 0, 2)}, {Question::Technique});
    EXPECT_FALSE(recommend(options).scenes.front().technique);
    options.needs = {techniques::Need::MovingCasters};
    EXPECT_EQ(recommend(options).scenes.front().technique->variant, "volume-zfail");
    options.needs = techniques::usualNeeds();
    options.standing = true;
    EXPECT_EQ(recommend(options).scenes.front().technique->variant, "sm-history");
}

TEST_F(Recorded, CastersOfASceneFileComeBesideTheTechnique) {
    Record one = record("a", "", 0.01, 2);
    one.scene = "plates";
    RecommendOptions options = asked({one}, {Question::Casters, Question::Technique});
    writeFile(folder_ / "plates.toml", platesText(onePlate));
    options.scenes = {(folder_ / "plates.toml").string()};
    options.casters.tolerance = {"0.09"};
    const Recommendations found = recommend(options);
    EXPECT_EQ(found.code, ExitCode::Pass);
    ASSERT_EQ(found.scenes.size(), 1U);
    ASSERT_TRUE(found.scenes.front().casters);
    EXPECT_EQ(found.scenes.front().casters->groups.front().level, 1U);
    EXPECT_TRUE(found.scenes.front().casters->verified);
    ASSERT_TRUE(found.scenes.front().technique);
    EXPECT_EQ(found.scenes.front().technique->variant, "a");
}

TEST_F(Recorded, SamplesAreCounted) {
    const RecommendOptions options =
        asked({record("b", "n=16", 0.02, 1), record("b", "n=64", 0.003, 1)}, {Question::Samples});
    const Recommendation one = recommend(options).scenes.front();
    ASSERT_EQ(one.samples.size(), 1U);
    EXPECT_EQ(one.samples.front().amount, 64);
    EXPECT_TRUE(one.maps.empty());
    EXPECT_FALSE(one.technique);
}

TEST_F(Recorded, TheDearerOfStandingAndMovingDecidesUnlessTheSceneStandsStill) {
    Record cached = record("a", "map=512", 0.001, 0.5), plain = record("a", "map=1024", 0.001, 1);
    for (const auto& [one, moving] : {std::pair{&cached, 40.0}, {&plain, 1.25}}) {
        one->values["cost.motion.time.median"] = 20 * moving;
        one->values["cost.motion.time.ratio"] = moving;
        one->values.list("cost.motion.time.samples") = {20 * moving};
        const auto standing = metrics::linesOf("cost.work"), moved = metrics::linesOf("cost.motion.work");
        for (std::size_t i = 0; i < moved.size(); ++i) one->values[moved[i]] = one->values[standing[i]];
    }
    RecommendOptions options = asked({cached, plain}, {Question::Technique});
    const auto moving = recommend(options).scenes.front().technique;
    ASSERT_TRUE(moving);
    EXPECT_EQ(moving->variant, "a:map=1024");
    EXPECT_EQ(moving->cost, 1.25);
    EXPECT_TRUE(moving->moving);
    options.standing = true;
    const auto standing = recommend(options).scenes.front().technique;
    ASSERT_TRUE(standing);
    EXPECT_EQ(standing->variant, "a:map=512");
    EXPECT_EQ(standing->cost, 0.5);
    EXPECT_FALSE(standing->moving);
}

TEST_F(Recorded, WithoutScoresOrRecordsThereIsNoAnswer) {
    Record one = record("a", "map=512", 0.001, 0.5);
    one.tolerances.clear();
    EXPECT_TRUE(recommend(asked({one}, {Question::Technique})).scenes.front().technique) << "the usual tolerance holds";
    test::clearAccuracy(one);
    EXPECT_EQ(test::messageOf<Inconclusive>([&] { recommend(asked({one}, {Question::Technique})); }),
              "no record of scene dueling-frusta is scored, so that nothing can be advised");
    one.scene = "simple";
    EXPECT_NE(test::messageOf<BadInput>([&] {
                  recommend(asked({one}, {Question::Technique}));
              }).find("holds no record of scene dueling-frusta"),
              std::string::npos);
}

constexpr double rounding = 0.015; // half of the pixels along the outline of the largest plate

TEST(Casters, AreGroupedByDistanceAndCastWhereTheyStand) {
    const Scene scene = plates(platesText(twoPlates + ", { at = [0, 9, 0] }"));
    const Casters casters(scene, 0, ownBands(scene));
    ASSERT_EQ(casters.groups().size(), 2U); // 3.2 and 4 m: up to 4 m; 7.4 m
    EXPECT_EQ(casters.groups()[0].placements.size(), 2U);
    EXPECT_EQ(casters.groups()[0].until, 4);
    EXPECT_EQ(casters.groups()[1].from, 4);
    EXPECT_EQ(casters.groups()[1].until, 8);
    EXPECT_EQ(casters.costs(), (Costs{{120, 56, 24}, {60, 28, 12}}));
    EXPECT_TRUE(casters.hasLevels(2));
    EXPECT_FALSE(casters.hasLevels(1)) << "the ground";
    EXPECT_EQ(casters.cast(casters.finest()).batches.size(), 3U);
    EXPECT_EQ(casters.castAlone(1, 0).batches.size(), 2U);
}

TEST(Casters, ChainsThatAUserAsksForFall) {
    const Scene scene = plates(platesText(twoPlates));
    for (const std::vector<int>& chain : {std::vector{12, 60}, {60, 60}, {60}, {60, 3}})
        EXPECT_NE(test::messageOf([&] {
                      withChains(scene, {{"plates", chain}});
                  }).find("falling numbers"),
                  std::string::npos)
            << chain.back();
}

TEST(HardChoices, ErrByWhatNoOtherCasterCovers) {
    const Scene scene = plates(platesText(twoPlates));
    const Casters casters(scene, 0, ownBands(scene));
    const Receivers ground = receivers(snapshot(scene, 0), scene.size, casters);
    const HardChoices choices(casters, ground, rayOracle(ground));
    EXPECT_EQ(choices.of({0, 0}).at("mismatch"), 0);
    EXPECT_NEAR(choices.of({1, 0}).at("mismatch"), 0.07, rounding);
    EXPECT_NEAR(choices.of({0, 2}).at("mismatch"), 0.15, rounding);
    EXPECT_NEAR(choices.of({1, 2}).at("mismatch"), 0.22, 2 * rounding);
    EXPECT_NEAR(choices.of({1, 2}).at("leak"), 0.22 / 0.32, 3 * rounding);
    EXPECT_EQ(choices.of({1, 2}).at("false_shadow"), 0);
}

TEST(HardChoices, CountPixelsThatEveryCasterLabels) {
    const Scene scene = plates(platesText(twoPlates));
    const Casters casters(scene, 0, ownBands(scene));
    const Receivers ground = receivers(snapshot(scene, 0), scene.size, casters);
    int asked = 0;
    const ShadowOracle oracle{
        "stand-in", [&](const Snapshot&) {
            Shadow shadow{Image<float>(scene.size.x, scene.size.y, 1), Image<std::uint8_t>(scene.size.x, scene.size.y, 1)};
            if (asked == 0) shadow.labelled[0] = 0;   // the first group's finest level: on an edge
            if (asked == 1) shadow.visibility[0] = 0; // its next one hides the pixel
            if (asked == 1) shadow.visibility[1] = 0;
            ++asked;
            return shadow;
        }};
    const HardChoices choices(casters, ground, oracle);
    const double counted = scene.size.x * scene.size.y - 1.0;
    EXPECT_DOUBLE_EQ(choices.of({1, 0}).at("false_shadow"), 1 / counted);
}

TEST(Oracles, LabelPlatesAlike) {
    const Scene scene = plates(platesText(twoPlates));
    const Casters casters(scene, 0, ownBands(scene));
    const Receivers ground = receivers(snapshot(scene, 0), scene.size, casters);
    const Shadow rays = rayOracle(ground).shadow(casters.cast(casters.finest()));
    const double lit = std::accumulate(rays.visibility.begin(), rays.visibility.end(), 0.0);
    EXPECT_NEAR(lit / static_cast<double>(rays.visibility.size()), 1 - 0.32, 2 * rounding);
    for (const std::size_t most : {1U, 60U, 120U, 1000U}) // each plate a part of its own, or both in one
        EXPECT_EQ(polygonOracle(ground, most).shadow(casters.cast(casters.finest())).visibility, rays.visibility) << most;
}

TEST(CasterRecommendation, OfAPlateIsTheCoarsestWithinTolerance) {
    std::vector<double> progress;
    const CasterRecommendation r =
        recommendCasters(plates(platesText(onePlate)), {}, [&](double done, std::string_view) { progress.push_back(done); });
    ASSERT_EQ(r.groups.size(), 1U);
    const GroupLevel& group = r.groups.front();
    EXPECT_EQ(group.object, "plates");
    EXPECT_EQ(group.level, 1U);
    EXPECT_EQ(group.instances, 1U);
    EXPECT_EQ(group.chain, (std::vector<std::size_t>{60, 28, 12, 0}));
    EXPECT_EQ(r.triangles, 28U);
    EXPECT_EQ(r.finestTriangles, 60U);
    EXPECT_EQ(r.drawnTriangles, 28U) << "just beyond 4 m";
    EXPECT_EQ(r.drawnErrors, r.errors);
    EXPECT_NEAR(r.errors.at("mismatch"), 0.07, rounding);
    ASSERT_TRUE(group.coarser);
    EXPECT_EQ(group.coarser->level, 2U);
    EXPECT_NEAR(group.coarser->errors.at("mismatch"), 0.15, rounding);
    EXPECT_EQ(group.coarser->errors, group.coarser->verified);
    EXPECT_EQ(r.receiverPixels, 2500U) << "the eye is below the plate";
    EXPECT_TRUE(std::ranges::is_sorted(progress));
    EXPECT_GE(progress.front(), 0);
    EXPECT_LT(progress.back(), 1);
    EXPECT_TRUE(std::ranges::any_of(progress, [](double done) { return done > 0.3 && done < 0.7; })) << "of the search";
}

// Under 4 m × 4 m of light as far above a plate as the plate is above the ground, the plate's penumbra reaches 2 m to either
// side of its edge, where it is half lit.
TEST(CasterRecommendation, OfLevelsWithAsManyTrianglesTheNextCoarserOneHasFewer) {
    std::string text = platesText(onePlate);
    text.replace(text.find("sides = 8"), 9, "sides = 16"); // and a smaller radius
    CasterOptions options;
    options.tolerance = {"mismatch=0.001"};
    const CasterRecommendation r = recommendCasters(plates(text), options);
    const GroupLevel& group = r.groups.front();
    EXPECT_EQ(group.chain, (std::vector<std::size_t>{60, 60, 12, 0}));
    EXPECT_EQ(group.level, 0U);
    ASSERT_TRUE(group.coarser);
    EXPECT_EQ(group.coarser->level, 2U);
}

TEST(CasterRecommendation, IsNotVerifiedWhereACoarserLevelWouldDoByTheOtherOracle) {
    const Scene scene =
        plates(platesText(onePlate, "kind = \"rectangle\", centre = [0.013, 18, 0.017], u = [4, 0, 0], v = [0, 0, 4]"));
    CasterOptions options;
    for (options.lightSamples = 4; options.lightSamples <= 32; ++options.lightSamples) {
        options.tolerance = {"mae=0.000001"};
        const CoarserLevel coarser = recommendCasters(scene, options).groups.front().coarser.value();
        const double exact = coarser.errors.at("mae"), sampled = coarser.verified.at("mae");
        if (sampled >= exact) continue;
        options.tolerance = {fmt::format("mae={}", 0.5 * (exact + sampled))};
        const CasterRecommendation r = recommendCasters(scene, options);
        EXPECT_EQ(r.groups.front().level, 0U);
        EXPECT_FALSE(r.verified);
        return;
    }
    FAIL() << "no number of points errs less than the exact fraction";
}

TEST(CasterRecommendation, UnderAnAreaLightIsOfWhatIsVisible) {
    const Scene scene =
        plates(platesText(onePlate, "kind = \"rectangle\", centre = [0.013, 18, 0.017], u = [4, 0, 0], v = [0, 0, 4]"));
    CasterOptions options;
    options.tolerance = {"rmse=0.01"};
    options.lightSamples = 16;
    std::vector<double> progress;
    const CasterRecommendation strict = recommendCasters(scene, options, [&](double done, std::string_view what) {
        if (what.starts_with("casters at levels")) progress.push_back(done);
    });
    ASSERT_GE(progress.size(), 2U);
    EXPECT_NEAR(progress[1] - progress[0], (0.7 - 0.3) / 4, 1e-9) << "one of four levels";
    EXPECT_EQ(strict.oracle, "area");
    EXPECT_EQ(strict.verifier, "rays from 16 points of the light");
    EXPECT_EQ(strict.groups.front().level, 0U);
    EXPECT_EQ(strict.errors.at("rmse"), 0);
    EXPECT_TRUE(strict.verified);
    options.tolerance = {"rmse=1"};
    const CasterRecommendation none = recommendCasters(scene, options);
    EXPECT_EQ(none.triangles, 0U);
    EXPECT_NEAR(none.errors.at("rmse"), none.verifiedErrors.at("rmse"), 0.02);
    EXPECT_GT(none.errors.at("rmse"), 0.2);
}

} // namespace
} // namespace shadowbench::recommend
