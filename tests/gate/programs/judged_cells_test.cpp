// Which cells of which program are run, counted, timed, swept and drawn.
#include "gate/judged_cells.h"

#include "base/temporary_folder.h"
#include "gate/failure_pictures.h"
#include "tests/gate/programs/one_renderer.h"
#include "tests/gate/programs/stand_in.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class CellsOfStandIns : public testing::Test {
protected:
    CellsOfStandIns() {
        writeFile(path("tiny.toml"), standInScene());
        options_.scenes = {path("tiny.toml")};
        options_.techniques = {"pcf", "none"};
        options_.bounds = path("bounds.toml");
        bounds("");
    }
    [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }
    void bounds(const std::string& text) const { writeFile(path("bounds.toml"), text); }
    [[nodiscard]] MeasuredProgram program(const StandIn& standIn) const { return {standIn.program(), path("cache")}; }
    /// "name: variants" of each step.
    [[nodiscard]] Words steps(bool instructions = false) const {
        Words words;
        for (const Step& step : JudgedCells(options_).steps(program(base_), instructions)) {
            words.push_back(step.name + ":");
            for (const std::string& variant : step.techniques) words.back() += " " + variant;
        }
        return words;
    }
    [[nodiscard]] Words timed() const {
        Words variants;
        for (const TimedCell& cell : JudgedCells(options_).timedCells(program(base_), program(head_)))
            variants.push_back(cell.variant);
        return variants;
    }
    static std::string entry(const std::string& kind, const std::string& scene, const std::string& technique) {
        return "[[" + kind + "]]\nscene = \"" + scene + "\"\ntechniques = [\"" + technique + "\"]\nreason = \"a test\"\n";
    }

    TemporaryFolder folder_;
    StandIn base_{folder_.path(), "base"}, head_{folder_.path(), "head"};
    GateOptions options_;
};

TEST_F(CellsOfStandIns, AreCountedWhereThePolicyNamesThemAndAllWhereItNamesNoneOfTheScenes) {
    EXPECT_EQ(steps(), Words{"tiny: pcf none"});
    EXPECT_EQ(steps(true), Words{"tiny, instructions: pcf none"});
    bounds(entry("count", "tiny", "pcf"));
    EXPECT_EQ(steps(true), (Words{"tiny: none", "tiny, instructions: pcf"}));
    EXPECT_EQ(steps(false), Words{"tiny: pcf none"});
    bounds(entry("count", "trees", "pcf"));
    EXPECT_EQ(steps(true), Words{"tiny, instructions: pcf none"});
    writeFile(path("other.toml"), standInScene());
    options_.scenes.push_back(path("other.toml"));
    bounds(entry("count", "tiny", "pcf"));
    EXPECT_EQ(steps(true), (Words{"tiny: none", "tiny, instructions: pcf", "other: pcf none"})) << "of one scene alone";
}

TEST_F(CellsOfStandIns, AreTimedWhereThePolicyNamesThemAndBothProgramsHaveThem) {
    EXPECT_EQ(timed(), (Words{"pcf", "none"}));
    bounds(entry("time", "tiny", "none"));
    EXPECT_EQ(timed(), Words{"none"});
    bounds(entry("time", "trees", "pcf"));
    EXPECT_EQ(timed(), (Words{"pcf", "none"}));
    const std::string one = R"([{"id": "none", "variants": [""], "parameters": []}])";
    head_.lists("techniques", one);
    EXPECT_EQ(timed(), Words{"none"}) << "the head has no other";
    options_.scenes = {"near-plane"}; // which neither program has
    EXPECT_EQ(timed(), Words{});
}

TEST_F(CellsOfStandIns, OfLevelsOfDetailAndThoseThatDoNotApplyHaveNoPairedTime) {
    const std::string more = R"([{"id": "pcss", "variants": [""], "parameters": []},)"
                             R"({"id": "lod-switch", "variants": [""], "parameters": []}])";
    for (const StandIn* standIn : {&base_, &head_}) standIn->lists("techniques", more);
    options_.techniques = {"pcss", "lod-switch"};
    EXPECT_EQ(timed(), Words{}) << "the scene has a point light, and no levels";
    writeFile(path("tiny.toml"), standInScene(areaLight));
    EXPECT_EQ(timed(), Words{"pcss"});
}

TEST_F(CellsOfStandIns, OfOtherRenderersHaveNoPairedTime) {
    options_.external = std::make_shared<OneRenderer>();
    options_.techniques = {"external:*", "pcf"};
    EXPECT_EQ(timed(), Words{"pcf"}) << "nobody says that they would take the same time again";
}

TEST_F(CellsOfStandIns, OfABuiltInSceneAreRunByProgramsThatHaveIt) {
    options_.scenes = {"near-plane"};
    EXPECT_EQ(steps(), Words{});
    base_.lists("scenes", R"([{"id": "near-plane"}])");
    EXPECT_EQ(steps(), Words{"near-plane: pcf none"});
}

TEST_F(CellsOfStandIns, AreSweptWhereTheProgramHasSceneAndTechnique) {
    const std::string axis = "axis = \"near-plane\"\nvalues = [1, 0.1]\n";
    options_.techniques = {"pcf", "none", "esm"}; // the last of which the program does not have
    bounds(entry("sweep", "tiny", "pcf") + axis + entry("sweep", "tiny", "esm") + axis + entry("sweep", "trees", "pcf") +
           axis);
    EXPECT_EQ(steps(), (Words{"tiny: pcf none", "tiny over near-plane: pcf"}));
    bounds(entry("sweep", "near-plane", "pcf") + axis);
    options_.scenes = {"near-plane"};
    EXPECT_EQ(steps(), Words{});
}

TEST_F(CellsOfStandIns, WithoutAPolicyOrATruthAreKnownNevertheless) {
    options_.bounds = path("nowhere.toml");
    EXPECT_THROW(JudgedCells{options_}, Inconclusive);
    options_.bounds = path("bounds.toml");
    EXPECT_FALSE(JudgedCells(options_).scenes.at(0).truths.empty());
    const std::string before = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    options_.scenes = {"large-light"}; // whose truth POV-Ray renders
    EXPECT_EQ(JudgedCells(options_).scenes.at(0).truths, "");
    setenv("PATH", before.c_str(), 1);
}

TEST_F(CellsOfStandIns, OfChoicesAreThoseThatMeanSomethingUnderTheLight) {
    writeFile(path("area.toml"), standInScene(areaLight));
    bounds(entry("choices", "tiny.toml", "*") + entry("choices", "area.toml", "*"));
    options_.scenes.clear();
    options_.techniques = {"pcf", "pcss", "esm", "lod-switch"};
    const JudgedCells cells(options_);
    const auto tried = [&](const std::string& scene, const std::string& technique) {
        const auto found = std::ranges::find(cells.scenes, scene, &JudgedScene::id);
        return found != cells.scenes.end() && std::ranges::any_of(found->variants, [&](const std::string& variant) {
                   return variant == technique || variant.starts_with(technique + ":");
               });
    };
    EXPECT_TRUE(tried("tiny", "pcf"));
    EXPECT_TRUE(tried("tiny", "esm"));
    EXPECT_FALSE(tried("tiny", "pcss")) << "a point light has no penumbra";
    EXPECT_TRUE(tried("area", "pcss"));
    EXPECT_FALSE(tried("area", "pcf")) << "it does there what it does elsewhere";
    EXPECT_FALSE(tried("tiny", "lod-switch")) << "it has no levels";
    const std::string last = std::ranges::find(cells.scenes, "tiny", &JudgedScene::id)->variants.back();
    bounds(entry("choices", "tiny.toml", "*") + "except = [\"" + last + "\"]\n");
    const JudgedCells fewer(options_);
    EXPECT_TRUE(cells.chooses("tiny", last));
    EXPECT_FALSE(fewer.chooses("tiny", last));
}

Change worse(const std::string& variant, Class of = Class::Leak, Direction direction = Direction::Worse) {
    return {"tiny", variant, "accuracy.leak", of, 0.1, 0.2, 0.01, direction, "worse"};
}

class PicturesOfStandIns : public CellsOfStandIns {
protected:
    [[nodiscard]] std::vector<FailurePictures> drawn(const std::vector<Change>& changes) const {
        const MeasuredProgram base = program(base_), head = program(head_);
        return drawFailures(changes, JudgedCells(options_), &base, head, path("out"), [](double, std::string_view) {});
    }
};

TEST_F(PicturesOfStandIns, AreOfCellsWhoseImagesAreWorseAndOfEachOnce) {
    const std::vector<FailurePictures> pictures = drawn(
        {worse("pcf", Class::Leak, Direction::Better), worse("none", Class::Instructions), worse("none", Class::Time),
         worse("none", Class::BreakPoint), worse("external:mine"), worse("esm"), worse("pcf"), worse("pcf", Class::Edge)});
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_EQ(pictures[0].variant, "pcf");
    EXPECT_TRUE(fs::exists(pictures[0].head / "visibility.png"));
    EXPECT_TRUE(pictures[0].headRecord);
}

TEST_F(PicturesOfStandIns, OfWhatTheBaseLacksAreOfTheHeadAlone) {
    base_.lists("techniques", R"([{"id": "none", "variants": [""], "parameters": []}])");
    const std::vector<FailurePictures> pictures = drawn({worse("pcf")});
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_FALSE(pictures[0].head.empty());
    EXPECT_TRUE(pictures[0].base.empty());
    EXPECT_FALSE(pictures[0].baseRecord);
    EXPECT_EQ(base_.calls("run"), 0);
}

TEST_F(PicturesOfStandIns, AreOfEachSceneItsOwn) {
    writeFile(path("other.toml"), standInScene());
    options_.scenes.push_back(path("other.toml"));
    Record other = standInRecord("pcf");
    other.scene = "other";
    for (const StandIn* standIn : {&base_, &head_}) standIn->measures({standInRecord("none"), other});
    Change ofOther = worse("pcf");
    ofOther.scene = "other";
    const std::vector<FailurePictures> pictures = drawn({worse("none"), ofOther});
    ASSERT_EQ(pictures.size(), 2U);
    EXPECT_TRUE(pictures[0].head.string().ends_with("tiny/none"));
    ASSERT_TRUE(pictures[1].headRecord);
    EXPECT_EQ(pictures[1].headRecord->scene, "other");
}

TEST_F(PicturesOfStandIns, OfTwoTechniquesOnOneSceneHaveTheRecordOfEach) {
    for (const StandIn* standIn : {&base_, &head_}) standIn->measures({standInRecord("none"), standInRecord("pcf")});
    const std::vector<FailurePictures> pictures = drawn({worse("pcf"), worse("none")});
    ASSERT_EQ(pictures.size(), 2U);
    for (const FailurePictures& cell : pictures) {
        ASSERT_TRUE(cell.headRecord);
        EXPECT_EQ(cell.headRecord->variant, cell.variant);
    }
}

TEST_F(PicturesOfStandIns, AreADozenAtMost) {
    options_.techniques.clear();
    std::vector<Change> changes;
    for (int map = 100; map < 113; ++map) {
        options_.techniques.push_back("pcf:map=" + std::to_string(map));
        changes.push_back(worse(options_.techniques.back()));
    }
    const std::vector<FailurePictures> pictures = drawn(changes);
    ASSERT_EQ(pictures.size(), 12U);
    EXPECT_EQ(pictures.back().variant, "pcf:map=111");
    EXPECT_FALSE(pictures.back().headRecord) << "the stand-in has none of it";
}

} // namespace
} // namespace shadowbench::gate
