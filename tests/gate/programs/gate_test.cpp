// The whole gate on stand-ins for base and head: what is judged, what is not and why, and what that comes to.
#include "gate/verdict.h"
#include "studies/shader_cost/shader_cost.h"
#include "tests/gate/programs/gate_of_stand_ins.h"
#include "tests/gate/programs/one_renderer.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

TEST_F(GateOfStandIns, EqualRecordsPass) {
    fs::create_symlink(head_.program(), path("link"));
    options_.head = path("link");
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Pass) << all(result.notCompared);
    EXPECT_EQ(result.base, base_.program());
    EXPECT_GT(result.changes.size(), 20U);
    EXPECT_TRUE(result.pictures.empty());
    EXPECT_TRUE(result.notCompared.empty());
}

/// What `shader-cost` leaves, with these executed cycles of its one shader.
std::string tellsOfShader(double executed) {
    shaders::ShaderCost cost{};
    cost.technique = "pcf";
    cost.scene = "simple";
    cost.pass = "resolve";
    cost.stage = gpu::Stage::Fragment;
    cost.source = "filtered/pcf/pcf.frag";
    cost.architecture = "navi21";
    cost.executed = gpu::Executed{executed, executed, 0, 0, 0, 0, 0};
    return "while [ $# -gt 0 ]; do [ \"$1\" = --out ] && out=$2; shift; done\nmkdir -p \"$out\"\n"
           "cat >\"$out/shader-cost.jsonl\" <<'END'\n" +
           shaders::toLines({"radv", {cost}}) + "END\n";
}

/// A change of `none` alone, of which the head leaks, beside two variants of pcf.
class GateByReach : public GateOfStandIns {
protected:
    GateByReach() {
        options_.techniques = {small, large, "none"};
        reaches(base_, "c0ffee", "3");
        reaches(head_, "decaf", "4");
        base_.measures({standInRecord(small), standInRecord(large), standInRecord("none")});
        head_.measures({headRecord(small), headRecord(large), leaking(headRecord("none"))});
    }

    void reaches(const StandIn& program, const std::string& commit, const std::string& none) const {
        program.is({commit, false, commit, readPolicy(options_.bounds, Profile::Gate),
                    Reach("* 1\nfiltered/pcf 2\nplanar/none " + none + "\nshader-figures 5\n")});
    }
    [[nodiscard]] std::ptrdiff_t measurementsOf(const std::string& program, const std::string& variant) const {
        const std::string calls = readFile(folder_.path() / program / "calls");
        std::ptrdiff_t count = 0;
        for (std::size_t at = 0; (at = calls.find("--technique " + variant + " ", at)) != std::string::npos; ++at) ++count;
        return count;
    }

    static constexpr const char *small = "pcf:map=64", *large = "pcf:map=128";
};

TEST_F(GateByReach, OfResultsThatNoChangeCanHaveReachedASampleIsMeasured) {
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression) << notCompared(result);
    EXPECT_TRUE(has(result.notes, "results of 2 of 3 are the base's")) << all(result.notes);
    EXPECT_TRUE(has(result.notes, "1 of these were measured as a check and are equal"));
    EXPECT_TRUE(has(result.notes, "1 cells were measured on neither side")) << all(result.notes);
    for (const char* program : {"base", "head"})
        EXPECT_EQ(measurementsOf(program, small) + measurementsOf(program, large), 1) << "the sample, by the " << program;
    EXPECT_FALSE(fs::exists(path("out/results.jsonl"))) << "it would not be whole";
    EXPECT_EQ(of(result, "accuracy.leak").size(), 2U) << "of none and the sample";
}

TEST_F(GateByReach, OnDemandAllIsMeasuredAndLaterGatesTakeWhatIsKept) {
    options_.all = true;
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression) << notCompared(result);
    EXPECT_EQ(measurementsOf("base", small) + measurementsOf("base", large), 2);
    EXPECT_EQ(measurementsOf("head", small) + measurementsOf("head", large), 1)
        << "the sample: the rest is kept of the base";
    const std::vector<Record> records = readRecords(path("out/results.jsonl"));
    ASSERT_EQ(records.size(), 3U);
    for (const Record& record : records) EXPECT_EQ(record.commit, "decaf") << record.variant;

    options_.all = false;
    const std::ptrdiff_t before = base_.calls("run");
    EXPECT_FALSE(has(gate(options_).notes, "on neither side"));
    EXPECT_EQ(base_.calls("run"), before + 1) << "for pictures";
    EXPECT_EQ(readRecords(path("out/results.jsonl")).size(), 3U);
}

TEST_F(GateByReach, WithAnotherPolicyNothingIsLeftOut) {
    bounds("[[bound]]\nscene = \"tiny\"\ntechniques = [\"pcf\"]\nmetric = \"leak\"\nbelow = 1e-6\nreason = \"a test\"\n");
    const GateResult result = gate(options_);
    EXPECT_FALSE(has(result.notes, "on neither side")) << all(result.notes);
    EXPECT_EQ(measurementsOf("base", small) + measurementsOf("base", large), 2);
}

TEST_F(GateByReach, ShadersThatNoChangeCanHaveReachedAreNotCompiled) {
    options_.shader = true;
    for (const StandIn* program : {&base_, &head_})
        program->does("shader-cost", "echo \"$*\" >>\"$here/compiled\"\n" + tellsOfShader(1000) + "exit 0\n");
    const GateResult result = gate(options_);
    EXPECT_TRUE(has(result.notes, "shaders of 2 of 3 are the base's")) << all(result.notes);
    const std::string compiled = readFile(folder_.path() / "head/compiled");
    EXPECT_NE(compiled.find("--technique none"), std::string::npos);
    EXPECT_EQ(compiled.find("--technique pcf"), std::string::npos) << compiled;
    head_.is({"decaf", false, "decaf", readPolicy(options_.bounds, Profile::Gate),
              Reach("* 1\nfiltered/pcf 2\nplanar/none 4\nshader-figures 6\n")});
    (void)gate(options_);
    EXPECT_NE(readFile(folder_.path() / "head/compiled").find("--technique pcf"), std::string::npos)
        << "by another model of a graphics processor";
}

TEST_F(GateOfStandIns, AKnownResultThatIsAnotherMakesTheGateInconclusiveAndAllIsMeasured) {
    const Reach reach("* 1\nfiltered/pcf 2\n");
    base_.is({"c0ffee", false, "one", {}, reach});
    head_.is({"decaf", false, "two", {}, reach});
    const std::string small = "pcf:map=64", large = "pcf:map=128";
    options_.techniques = {small, large};
    base_.measures({standInRecord(small), standInRecord(large)});
    head_.measures({leaking(headRecord(small)), leaking(headRecord(large))});
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Inconclusive);
    EXPECT_TRUE(has(result.notCompared, "on tiny differs from the base")) << all(result.notCompared);
    for (const Record& record : readRecords(path("out") + "/results.jsonl"))
        EXPECT_EQ(record.values["accuracy.leak"], 0.1) << record.variant;
}

TEST_F(GateOfStandIns, AWorseHeadIsARegressionWithPicturesOfBoth) {
    head_.measures({leaking(headRecord())});
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression);
    ASSERT_EQ(result.pictures.size(), 1U);
    EXPECT_EQ(result.pictures[0].head, path("out") + "/pictures/head/images/tiny/pcf");
    EXPECT_EQ(result.pictures[0].base, path("out") + "/pictures/base/images/tiny/pcf");
    ASSERT_TRUE(result.pictures[0].headRecord && result.pictures[0].baseRecord);
    EXPECT_EQ(result.pictures[0].headRecord->values["accuracy.leak"], 0.1);
}

TEST_F(GateOfStandIns, AgainstRecordsOnlyTheHeadIsDrawnAndNoTimeJudged) {
    compareWith({standInRecord("pcf")});
    head_.measures({leaking(headRecord())});
    options_.time = true;
    const GateResult result = gate(options_);
    ASSERT_EQ(result.pictures.size(), 1U);
    EXPECT_TRUE(result.pictures[0].base.empty());
    EXPECT_FALSE(result.pictures[0].baseRecord);
    EXPECT_TRUE(has(result.notes, "this build's policy alone judges"));
    EXPECT_TRUE(has(result.notes, "time is not compared: the base is a file of records"));
}

TEST_F(GateOfStandIns, ASlowerShaderIsACostRegressionThatIsToldBeforeAnythingIsDrawn) {
    options_.shader = true;
    base_.does("shader-cost", tellsOfShader(1000) + "exit 0\n");
    head_.does("shader-cost", tellsOfShader(1010) + "exit 0\n");
    head_.does("run", "[ -e '" + path("out/shader-cost/base/shader-cost.jsonl") + "' ] || exit 1\n");
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::CostRegression) << all(result.notCompared);
    const std::vector<Change> changes = of(result, "resolve fragment filtered/pcf/pcf.frag");
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].direction, Direction::Worse);
    EXPECT_TRUE(result.pictures.empty());
    EXPECT_TRUE(readFile(folder_.path() / "head/calls").find("--technique pcf") != std::string::npos);
    options_.techniques.clear();
    EXPECT_EQ(of(gate(options_), changes[0].metric).size(), 1U);
    const std::string calls = readFile(folder_.path() / "head/calls");
    const std::size_t last = calls.rfind("shader-cost ");
    EXPECT_EQ(calls.substr(last, calls.find('\n', last) - last).find("--technique"), std::string::npos)
        << "of all that it knows, shown or not";
}

TEST_F(GateOfStandIns, AWaiverAcceptsASlowerShaderOfItsVariants) {
    options_.shader = true;
    base_.does("shader-cost", tellsOfShader(1000) + "exit 0\n");
    head_.does("shader-cost", tellsOfShader(1010) + "exit 0\n");
    bounds("[[waiver]]\nscene = \"*\"\ntechniques = [\"pcf\"]\nclass = \"shader\"\nreason = \"test\"\n"
           "expires = \"9999-12-31\"\n");
    EXPECT_EQ(gate(options_).code(), ExitCode::Pass);
}

TEST_F(GateOfStandIns, AMachineWithoutTheDriverAndABaseWithoutTheVerbLeaveShadersOutWithANote) {
    options_.shader = true;
    base_.does("shader-cost", "echo 'unknown verb shader-cost' >&2\nexit 2\n");
    head_.does("shader-cost", tellsOfShader(1000) + "exit 0\n");
    const GateResult older = gate(options_);
    EXPECT_EQ(older.code(), ExitCode::Pass) << all(older.notCompared);
    EXPECT_TRUE(has(older.notes, "shaders are not compared: the base cannot tell their figures: unknown verb"));
    head_.does("shader-cost", "echo 'shadowbench: install it with apt-get install mesa-vulkan-drivers' >&2\nexit 5\n");
    const GateResult without = gate(options_);
    EXPECT_EQ(without.code(), ExitCode::Pass) << all(without.notCompared);
    EXPECT_TRUE(has(without.notes, "shaders are not compared: install it with apt-get install mesa-vulkan-drivers"))
        << all(without.notes);
}

TEST_F(GateOfStandIns, FiguresOfShadersThatAreMissingOtherwiseAreInconclusive) {
    options_.shader = true;
    base_.does("shader-cost", tellsOfShader(1000) + "exit 0\n");
    head_.does("shader-cost", "echo 'shadowbench: lost' >&2\nexit 1\n");
    EXPECT_TRUE(has(gate(options_).notCompared, "shaders of the head have no figures: lost"));
    head_.does("shader-cost", tellsOfShader(1000) + "echo 'shadowbench: pcf:map=16: no such function' >&2\nexit 1\n");
    const GateResult partly = gate(options_);
    EXPECT_EQ(partly.code(), ExitCode::Inconclusive);
    EXPECT_TRUE(has(partly.notCompared, "shaders of the head have no figures: pcf:map=16: no such function"));
    base_.does("shader-cost", "exit 1\n");
    head_.does("shader-cost", tellsOfShader(1000) + "exit 0\n");
    EXPECT_TRUE(has(gate(options_).notCompared, "shaders of the base have no figures"));
}

TEST_F(GateOfStandIns, RecordsHaveNoShaders) {
    options_.shader = true;
    compareWith({standInRecord("pcf")});
    EXPECT_TRUE(has(gate(options_).notes, "shaders are not compared: the base is a file of records, not a program"));
    EXPECT_EQ(head_.calls("shader-cost"), 0);
}

TEST_F(GateOfStandIns, RecordsOfOtherCellsAreNotCompared) {
    Record otherProfile = standInRecord("pcf"), otherSeed = standInRecord("pcf", 2), otherScene = standInRecord("pcf");
    otherProfile.profile = "paper";
    otherScene.scene = "trees"; // judged only by a gate of all techniques on the standard scenes
    compareWith({otherProfile, otherSeed, otherScene, standInRecord("none")});
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Inconclusive);
    EXPECT_TRUE(has(result.notCompared, "no cell is scored in both")) << all(result.notCompared);
    EXPECT_EQ(result.presence.isNew, std::vector<std::string>{"pcf on tiny"});
    EXPECT_EQ(result.presence.compared, 0U);
}

TEST_F(GateOfStandIns, TheSameCommitAgainstItsRecordsDecidesNothingUnlessThatIsMeant) {
    compareWith({headRecord()});
    EXPECT_EQ(gate(options_).code(), ExitCode::Inconclusive);
    options_.sameProgram = true;
    EXPECT_EQ(gate(options_).code(), ExitCode::Pass);
}

TEST_F(GateOfStandIns, InstructionsAreJudgedWhereTheBaseHasThem) {
    options_.instructions = true;
    compareWith({standInRecord("pcf")});
    EXPECT_TRUE(has(gate(options_).notes, "instructions are not compared: the base's records hold none"));
    Record before = standInRecord("pcf"), now = headRecord();
    before.values["cost.instructions"] = 1e6;
    now.values["cost.instructions"] = 1.1e6;
    before.environment.valgrind = now.environment.valgrind = "3.19.0";
    compareWith({before});
    head_.measures({now});
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::CostRegression);
    EXPECT_FALSE(has(result.notes, "instructions are not compared"));
    EXPECT_TRUE(result.pictures.empty()) << "of a cost there is nothing to see";
}

TEST_F(GateOfStandIns, ACellThatFailsOrIsMissingIsNamed) {
    Record failed = headRecord();
    failed.status = Status::Error;
    failed.reason = "the primary hits differ";
    head_.measures({failed});
    EXPECT_NE(notCompared(gate(options_)).find("pcf on tiny cannot be compared: it is error: the primary hits differ\n"),
              std::string::npos);
    const StandIn other(folder_.path(), "other");
    options_.head = other.program();
    other.measures({headRecord("none")});
    EXPECT_EQ(gate(options_).presence.gone, std::vector<std::string>{"pcf on tiny"});
}

TEST_F(GateOfStandIns, AFailureOfTheBaseIsNoImprovement) {
    Record failed = standInRecord("pcf");
    failed.status = Status::Error;
    failed.reason = "the shader fails";
    base_.measures({failed});
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Inconclusive);
    EXPECT_NE(notCompared(result).find("pcf on tiny cannot be compared: it is error before: the shader fails\n"),
              std::string::npos);
}

TEST_F(GateOfStandIns, WhatTheBaseDoesNotKnowIsNewAndPasses) {
    base_.lists("techniques", R"([{"id": "none", "variants": [""], "parameters": []}])");
    base_.measures({standInRecord("none")});
    head_.measures({headRecord("none"), headRecord("pcf")});
    options_.techniques = {"none", "pcf"};
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Pass) << notCompared(result);
    EXPECT_EQ(result.presence.isNew, std::vector<std::string>{"pcf on tiny"});
}

TEST_F(GateOfStandIns, LeavesTheHeadsRecordsAsABaseForLater) {
    head_.measures({leaking(headRecord())});
    EXPECT_EQ(gate(options_).code(), ExitCode::AccuracyRegression);
    options_.base = path("out/results.jsonl");
    options_.sameProgram = true;
    const GateResult accepted = gate(options_);
    EXPECT_EQ(accepted.code(), ExitCode::Pass) << notCompared(accepted);
}

TEST_F(GateOfStandIns, AWaiverAcceptsAndTheHeadsIsListedFirst) {
    head_.measures({leaking(headRecord())});
    const std::string waiver = "[[waiver]]\nscene = \"tiny\"\ntechniques = [\"pcf\"]\nclass = \"leak\"\n"
                               "reason = \"a test\"\nexpires = \"9999-12-31\"\n";
    bounds(waiver);
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Pass) << notCompared(result);
    EXPECT_EQ(std::ranges::count(result.changes, Direction::Waived, &Change::direction), 1);
    EXPECT_TRUE(has(result.loosened, "this build accepts, and its base does not, leak of pcf on tiny"));
    EXPECT_TRUE(result.pictures.empty());
    base_.is({"c0ffee", false, "base", readPolicy(options_.bounds, Profile::Gate)});
    EXPECT_TRUE(gate(options_).loosened.empty()) << "its base accepts it, too";
}

TEST_F(GateOfStandIns, ALooserAllowanceOfTheHeadIsListedAndTheBasesJudges) {
    BuildInfo before{"c0ffee", false, "base", readPolicy(options_.bounds, Profile::Gate)};
    before.policy.rules.limits.at("accuracy.leak").relative = 0;
    before.policy.rules.limits.at("accuracy.leak").pixels = 0;
    base_.is(before);
    head_.measures({leaking(headRecord(), 0.0004001)});
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression);
    EXPECT_TRUE(has(result.loosened, "the allowance accuracy.leak: pixels was 0 and is 2")) << all(result.loosened);
}

TEST_F(GateOfStandIns, TwoBuildsOfTheSameProgramDecideNothing) {
    options_.head = base_.program();
    EXPECT_NE(complaint().find("base and head are one program"), std::string::npos) << complaint();
    options_.sameProgram = true;
    EXPECT_EQ(gate(options_).code(), ExitCode::Pass);
    options_.sameProgram = false;
    base_.does("policy", "exit 2\n");
    EXPECT_NE(complaint().find("base and head are one program"), std::string::npos)
        << "though they say nothing of themselves";
}

TEST_F(GateOfStandIns, OfAllCellsAreThoseThatRecordsHaveOfTheStandardScenes) {
    Record gone = standInRecord("gone"), other = standInRecord("gone"), step = standInRecord("gone");
    gone.scene = step.scene = "dueling-frusta";
    step.sweep = SweepStep{"near-plane", "m", "gone", 1, 0.1};
    other.scene = "near-plane";
    compareWith({gone, other, step});
    Record there = headRecord("none");
    there.scene = "dueling-frusta";
    head_.measures({there});
    head_.lists("scenes", R"([{"id": "dueling-frusta"}])");
    options_.scenes.clear();
    options_.techniques.clear();
    options_.cache.clear();
    setenv("SHADOWBENCH_CACHE", path("own-cache").c_str(), 1);
    const GateResult result = gate(options_);
    unsetenv("SHADOWBENCH_CACHE");
    EXPECT_TRUE(fs::exists(path("own-cache"))) << "what the head has of them was measured there";
    EXPECT_EQ(std::ranges::count(result.presence.gone, "gone on dueling-frusta"), 1);
    EXPECT_EQ(std::ranges::count(result.presence.gone, "gone on near-plane"), 0);
    EXPECT_NE(notCompared(result).find("pcf on dueling-frusta was not measured"), std::string::npos);
}

TEST_F(GateOfStandIns, OfAllTechniquesAreThoseThatRecordsHaveOfTheScenesThatAreNamed) {
    Record gone = standInRecord("gone"), standard = standInRecord("gone");
    standard.scene = "dueling-frusta";
    compareWith({gone, standard, standInRecord("pcf")});
    options_.techniques.clear();
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Inconclusive) << "most of them the head does not have";
    EXPECT_EQ(std::ranges::count(result.changes, Direction::Worse, &Change::direction), 0) << "nobody judges what is gone";
}

TEST_F(GateOfStandIns, CommitsThatMakeTheSameProgramPassUnlessThePolicyDiffers) {
    BuildInfo before{"c0ffeec0ffeec0ffee", false, "same", readPolicy(options_.bounds, Profile::Gate)}, now = before;
    now.commit = "decafdecafdecaf";
    base_.is(before);
    head_.is(now);
    const GateResult same = gate(options_);
    EXPECT_EQ(same.code(), ExitCode::Pass);
    EXPECT_TRUE(has(same.notes, "commits c0ffeec0ffee and decafdecafde make the same program")) << all(same.notes);
    EXPECT_EQ(base_.calls("run"), 0);

    before.policy.config.bounds = {{{"tiny", {"pcf"}, {}, "a test"}, "leak", 1e-6, true}};
    base_.is(before);
    const GateResult stricter = gate(options_);
    EXPECT_EQ(stricter.code(), ExitCode::AccuracyRegression) << "the base's bound judges";
    EXPECT_TRUE(has(stricter.loosened, "the base's [bound] pcf on tiny: leak below 1e-06 is gone or looser here"));

    before.policy.config.bounds.clear();
    base_.is(before);
    bounds("[[bound]]\nscene = \"tiny\"\ntechniques = [\"pcf\"]\nmetric = \"leak\"\nbelow = 1e-6\nreason = \"a test\"\n");
    EXPECT_EQ(gate(options_).code(), ExitCode::AccuracyRegression) << "the head's bound judges";
}

TEST_F(GateOfStandIns, OneCommitWithChangesIsAnotherProgramThanWithout) {
    BuildInfo before{"c0ffeec0ffeec0ffee", false, "same", readPolicy(options_.bounds, Profile::Gate)}, now = before;
    base_.is(before);
    head_.is(now);
    EXPECT_NE(complaint().find("base and head are one program"), std::string::npos) << "one commit";
    now.dirty = true;
    head_.is(now);
    EXPECT_EQ(gate(options_).code(), ExitCode::Pass);
}

TEST_F(GateOfStandIns, ABaseThatSaysNoPolicyIsJudgedByThisBuilds) {
    base_.does("policy", "exit 2\n");
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Pass);
    EXPECT_TRUE(has(result.notes, "the base was built before programs said what they judge"));
    base_.is({"c0ffee", false, "base", {}});
    base_.does("policy", "");
    head_.does("policy", "exit 2\n");
    EXPECT_EQ(gate(options_).code(), ExitCode::Pass);
}

TEST_F(GateOfStandIns, WhatTheBaseShowsAndThisBuildDoesNotHaveIsUnjudged) {
    base_.lists("techniques", R"([{"id": "pcf", "variants": [""], "parameters": []},)"
                              R"({"id": "gone", "variants": [""], "parameters": []}])");
    options_.techniques.clear();
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::Inconclusive);
    EXPECT_NE(notCompared(result).find("gone, which the base shows, no longer exists"), std::string::npos);
}

TEST_F(GateOfStandIns, ABoundOnASceneThatNobodyHasIsNoted) {
    bounds("[[bound]]\nscene = \"nowhere\"\ntechniques = [\"pcf\"]\nmetric = \"leak\"\nbelow = 1\nreason = \"a test\"\n");
    EXPECT_TRUE(has(gate(options_).notes, "names a scene \"nowhere\" that is not among the chosen ones"));
}

TEST_F(GateOfStandIns, WhatTheSceneExpectsIsJudgedOfItsProfileOnly) {
    writeFile(path("tiny.toml"), standInScene() + "[expect]\nholds = [{ technique = \"pcf\", metric = \"leak\", below = "
                                                  "1e-6, reason = \"a test\" }]\n");
    const GateResult result = gate(options_);
    EXPECT_EQ(of(result, "bound.leak").size(), 1U);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression);
    options_.profile = Profile::Standard;
    EXPECT_EQ(of(gate(options_), "bound.leak").size(), 0U);
}

TEST_F(GateOfStandIns, WhatIsDrawnByChanceIsMeasuredWithEightSeeds) {
    bounds("[[seeds]]\nscene = \"tiny\"\ntechniques = [\"pcf\"]\nreason = \"a test\"\n");
    std::vector<Record> before, now;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        before.push_back(leaking(standInRecord("pcf", seed), 0.01 + 0.001 * (seed % 3)));
        now.push_back(leaking(headRecord("pcf", seed), 0.01 + 0.001 * ((seed + 1) % 3)));
    }
    base_.measures(before);
    head_.measures(now);
    EXPECT_EQ(gate(options_).code(), ExitCode::Pass);
    EXPECT_EQ(head_.calls("run"), 8);
}

constexpr const char* sweepOfTiny =
    "[[sweep]]\nscene = \"tiny\"\ntechniques = [\"pcf\"]\naxis = \"near-plane\"\nvalues = [1, 0.1]\nreason = \"a test\"\n";

std::vector<Record> swept(Record record, double breakPoint) {
    std::vector<Record> records{record};
    for (const double value : {1.0, 0.1}) {
        record.sweep = SweepStep{"near-plane", "m", "pcf", value, breakPoint};
        records.push_back(record);
    }
    return records;
}

TEST_F(GateOfStandIns, ABreakPointThatComesEarlierIsWorse) {
    bounds(sweepOfTiny);
    base_.measures(swept(standInRecord("pcf"), 0.1));
    head_.measures(swept(headRecord(), 1));
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression);
    EXPECT_EQ(std::ranges::count(result.changes, Class::BreakPoint, &Change::changeClass), 1);
    EXPECT_EQ(head_.calls("sweep"), 1);
}

TEST_F(GateOfStandIns, ABaseOfRecordsWithoutSweepsJudgesNone) {
    bounds(sweepOfTiny);
    head_.measures(swept(headRecord(), 1));
    compareWith({standInRecord("pcf")});
    const GateResult without = gate(options_);
    EXPECT_TRUE(has(without.notes, "not compared, for the base's records hold nothing of them: break points"));
    EXPECT_EQ(without.code(), ExitCode::Pass) << all(without.notCompared);
    compareWith(swept(standInRecord("pcf"), 0.1));
    EXPECT_EQ(gate(options_).code(), ExitCode::AccuracyRegression);
}

TEST_F(GateOfStandIns, OtherRenderersAreCalledByTheHeadEachTimeAndComparedWithRecords) {
    options_.external = std::make_shared<OneRenderer>();
    options_.externalFiles = {path("engine.toml")};
    options_.techniques = {"external:*"};
    EXPECT_NE(complaint().find("--external needs records as --base"), std::string::npos) << complaint();
    compareWith({standInRecord("external:copy")});
    head_.measures({leaking(headRecord("external:copy"))});
    const GateResult result = gate(options_);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression);
    EXPECT_EQ(head_.calls("run"), 1) << "its pictures are of that call";
    ASSERT_EQ(result.pictures.size(), 1U);
    EXPECT_TRUE(fs::exists(result.pictures[0].head / "visibility.png"));
    EXPECT_TRUE(result.pictures[0].base.empty());
    writeFile(path("records/images/tiny/external_copy/visibility.png"), "beside its records");
    EXPECT_EQ(readFile(gate(options_).pictures.at(0).base / "visibility.png"), "beside its records");
    EXPECT_EQ(head_.calls("run"), 2);
}

} // namespace
} // namespace shadowbench::gate
