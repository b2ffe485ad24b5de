// The gate's report: the verdict in words, how to see again what is worse, pictures, notes and the slowest parts.
#include "gate/gate.h"
#include "gate/gate_report.h"
#include "gate/sarif.h"
#include "gate/verdict.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

Change worse(const std::string& scene, const std::string& variant, Class what = Class::Leak) {
    return {scene, variant, "accuracy.leak", what, 0.1, 0.2, 0.01, Direction::Worse, variant + " on " + scene + " leaks"};
}

GateOptions optionsOf(const std::string& base = "v1") {
    GateOptions options;
    options.base = base;
    return options;
}

GateResult resultOf(const std::vector<Change>& changes) {
    GateResult result;
    result.head = "decaf";
    result.base = "v1 (c0ffee)";
    result.changes = changes;
    return result;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(GateReport, SaysTheVerdictInWords) {
    const auto last = [](const GateResult& result) {
        const std::string text = gateReport(result, optionsOf());
        return text.substr(text.rfind("gate: "));
    };
    EXPECT_EQ(last(resultOf({})), "gate: pass (head decaf, base v1 (c0ffee))\n");
    EXPECT_TRUE(contains(last(resultOf({worse("trees", "pcf")})), "gate: accuracy or stability regression"));
    EXPECT_TRUE(contains(last(resultOf({worse("trees", "pcf", Class::Work)})), "gate: cost regression"));
    GateResult unsure = resultOf({});
    unsure.notCompared = {"pcf on trees was not measured"};
    EXPECT_TRUE(contains(last(unsure), "gate: inconclusive"));
    EXPECT_TRUE(contains(gateReport(unsure, optionsOf()), "not compared:\n  pcf on trees was not measured\n"));
    EXPECT_TRUE(gateComment(resultOf({}), optionsOf()).starts_with("## shadowbench: pass\n\nHead decaf, base v1"));
}

TEST(GateReport, NamesEachCommandOnceHoweverMuchOfItsCellIsWorse) {
    const GateResult result = resultOf({worse("trees", "pcf"),
                                        worse("trees", "pcf", Class::Edge),
                                        worse("trees", "vsm"),
                                        {"trees", "esm", "m", Class::Leak, 1, 0.5, 0, Direction::Better, "better"}});
    const std::string text = gateReport(result, optionsOf()), comment = gateComment(result, optionsOf());
    const std::string command = reproduction(result.changes[0], optionsOf());
    EXPECT_TRUE(contains(text, "to see it again:\n  " + command + "\n"));
    EXPECT_EQ(text.find(command), text.rfind(command));
    EXPECT_TRUE(contains(comment, "\nTo see it again:\n* `" + command + "`\n")) << comment;
    EXPECT_FALSE(contains(text, "--technique esm"));
}

TEST(GateReport, NamesTheCommandOfACallThatFailedButNotOfARowThatIsGone) {
    GateResult result = resultOf({worse("trees", "external:engine", Class::Status), worse("trees", "external:gone")});
    for (Change& change : result.changes) change.direction = Direction::NotCompared;
    result.presence.failed = {"external:engine on trees"};
    const std::string text = gateReport(result, optionsOf());
    EXPECT_TRUE(contains(text, "shadowbench run --images --cost none --out results/reproduced --scene trees --technique "
                               "external:engine"))
        << text;
    EXPECT_FALSE(contains(text, "--technique external:gone")) << text;
}

TEST(GateReport, ShowsThePicturesThatThereAre) {
    GateResult result = resultOf({worse("trees", "pcf")});
    result.pictures = {{"trees", "pcf", "out/head", "", {}, {}}, {"trees", "vsm", "out/head", "out/base", {}, {}}};
    const std::string text = gateReport(result, optionsOf());
    EXPECT_TRUE(contains(text, "  pcf on trees: out/head/{visibility,reference,error}.png\n")) << text;
    EXPECT_TRUE(contains(text, "error}.png out/base/{visibility"));
}

TEST(GateReport, ListsTheFiveSlowestPartsThatTookASecond) {
    GateResult result = resultOf({});
    result.seconds = 90;
    for (const double seconds : {3.0, 0.4, 7.0, 1.0, 5.0, 6.0, 4.0}) result.times.push_back({"part", seconds});
    const std::string text = gateReport(result, optionsOf());
    const std::string slowest = text.substr(text.find("slowest parts of 90 s"));
    EXPECT_TRUE(contains(slowest, "7 s  part\n  6 s  part\n  5 s  part\n  4 s  part\n  3 s  part\ngate:")) << slowest;
    result.times = {{"part", 0.4}};
    EXPECT_FALSE(contains(gateReport(result, optionsOf()), "slowest")) << "nothing took a second";
}

TEST(GateReport, CommandsCanBePastedIntoAShell) {
    GateOptions options = optionsOf("HEAD~1");
    options.externalFiles = {"my engine.toml"};
    Change change = worse("a scene.toml", "external:engine", Class::Instructions);
    EXPECT_EQ(reproduction(change, options), "shadowbench run --cost instructions --scene 'a scene.toml' --technique "
                                             "external:engine --profile gate --seed 1 --external 'my engine.toml'");
    options.scenes = {"trees", "shadows/yard.toml"};
    change.scene = "yard";
    EXPECT_TRUE(contains(reproduction(change, options), " --scene shadows/yard.toml ")) << "its id names no file";
    change.variant = "pcf"; // which needs no other renderer
    EXPECT_FALSE(contains(reproduction(change, options), "--external"));
    change.changeClass = Class::Time;
    EXPECT_TRUE(contains(reproduction(change, options), "--base 'HEAD~1'"));
}

TEST(GateReport, AShaderIsShownAgainByWhatTheBaseSaidOfIt) {
    GateOptions options = optionsOf();
    options.out = "results/gate";
    EXPECT_EQ(reproduction(worse("simple", "pcss:taps=32+32", Class::Shader), options),
              "./bench shader-cost --technique pcss:taps=32+32 --base results/gate/shader-cost/base/shader-cost.jsonl");
}

TEST(Sarif, HasAShaderAtItsFile) {
    Change pcf = worse("simple", "pcf", Class::Shader), mean = pcf;
    pcf.metric = "resolve fragment filtered/pcf/pcf.frag";
    pcf.file = "filtered/pcf/pcf.frag";
    mean.metric = "mean fragment shared/sampling/mean.frag";
    mean.file = "shared/sampling/mean.frag";
    const std::string text = sarif(resultOf({pcf, mean, worse("simple", "pcf")}), optionsOf(), "");
    for (const char* part :
         {"\"uri\": \"techniques/filtered/pcf/pcf.frag\"", "\"uri\": \"techniques/shared/sampling/mean.frag\"",
          "\"uri\": \"techniques/catalog.inc\"", "\"cell/v1\": \"mean fragment shared/sampling/mean.frag: shader\""})
        EXPECT_TRUE(contains(text, part)) << part << text;
}

/// One change of each direction.
std::vector<Change> oneOfEach() {
    std::vector<Change> changes;
    for (const Direction direction : {Direction::Better, Direction::Same, Direction::Worse, Direction::Unclear,
                                      Direction::NotCompared, Direction::Waived}) {
        changes.push_back(worse("trees", "pcf"));
        changes.back().direction = direction;
        changes.back().sentence = "change " + std::to_string(changes.size());
    }
    return changes;
}

Comparison comparisonOf(const std::vector<Change>& changes) { return {changes, {2, 1, {}, {}, {"pcf on trees"}, {}}}; }

TEST(ChangesReport, ListsTheWorstFirstAndCountsTheRest) {
    EXPECT_EQ(
        changesReport(comparisonOf(oneOfEach())),
        "worse        leak          change 3\nnot compared leak          change 5\nunclear      leak          change 4\n"
        "waived       leak          change 6\nbetter       leak          change 1\n1 worse, 1 better, 1 the same, 1 "
        "unclear, "
        "1 waived, 1 not compared; 1 of 2 expected results compared; failed: pcf on trees\n");
    EXPECT_EQ(changesReport({}), "0 worse, 0 better, 0 the same; 0 of 0 expected results compared\n");
}

TEST(GateComment, NamesTheWorstOfEachResultAndCause) {
    std::vector<Change> changes;
    for (int i = 0; i < 24; ++i) {
        changes.push_back(worse("trees", "pcf" + std::to_string(i / 2)));
        changes.back().head = 0.2 + 0.01 * i;
        changes.back().sentence = "change " + std::to_string(i);
    }
    const std::string comment = gateComment(resultOf(changes), optionsOf());
    EXPECT_TRUE(contains(comment, "\nWorse:\n* worse: change 23, and 1 more of leak\n* worse: change 21,")) << comment;
    EXPECT_FALSE(contains(comment, "change 22"));
    EXPECT_TRUE(contains(comment, "* … and 2 more\n")) << comment;
}

TEST(GateComment, HasFortyLinesHoweverMuchIsWorse) {
    GateResult result = resultOf({});
    for (int i = 0; i < 100; ++i) {
        for (Change change : oneOfEach()) {
            change.variant += std::to_string(i);
            change.sentence = "several\nlines\nof words";
            result.changes.push_back(change);
        }
        result.loosened.emplace_back("the base's bound is gone");
        result.notCompared.emplace_back("not measured");
    }
    const std::string comment = gateComment(result, optionsOf());
    EXPECT_LE(std::ranges::count(comment, '\n'), 40) << comment;
    EXPECT_TRUE(comment.starts_with("## shadowbench: inconclusive\n")) << comment;
    EXPECT_LT(comment.find("Looser than the base:"), comment.find("Worse:"));
    EXPECT_TRUE(contains(comment, "* … and 90 more\n")) << comment;

    result.logs = {{"external:engine on trees", "out/log.txt", std::vector<std::string>(20, "````lost")},
                   {"another", "", {}}};
    const std::string failed = gateComment(result, optionsOf());
    EXPECT_LE(std::ranges::count(failed, '\n'), 40) << failed;
    EXPECT_TRUE(contains(failed, "\nexternal:engine on trees, in its own words (1 more on the page):\n````\n")) << failed;
    EXPECT_TRUE(contains(failed, " ```lost\n````\n")) << "what it said ends no block";
    EXPECT_TRUE(
        contains(gateReport(result, optionsOf()), "external:engine on trees; its last lines, of out/log.txt:\n  ````l"));
}

TEST(Annotations, AreOneForEachResultAndCauseAndWarnOfWhatIsUnclearOrNotJudged) {
    EXPECT_EQ(annotations(oneOfEach()),
              "::error title=leak is worse::change 3\n::warning title=leak is not compared::change "
              "5\n::warning title=leak is unclear::change 4\n");
    EXPECT_EQ(annotations({worse("trees", "pcf"), worse("trees", "pcf")}),
              "::error title=leak is worse::pcf on trees leaks, and 1 more of leak\n");
}

TEST(Annotations, NoSentenceIsTakenForACommand) {
    Change change = worse("trees", "pcf");
    change.sentence = "100 %\r\n::stop-commands::x";
    EXPECT_EQ(annotations({change}), "::error title=leak is worse::100 %25%0D%0A::stop-commands::x\n");
}

TEST(JUnit, SaysWhatATimeThatPassedWouldHaveTold) {
    const Change time{"trees", "pcf", "time.ratio", Class::Time, 1, 1, 0.01, Direction::Same, "2 % would have been told"};
    EXPECT_TRUE(contains(junit({time}), "<system-out>2 % would have been told\n</system-out>")) << junit({time});
}

TEST(Excess, OfWhatHasNoNumberIsTheMost) {
    Change change;
    change.base = 1;
    EXPECT_TRUE(std::isinf(excess(change))) << "the head has none";
    change.head = 3;
    change.allowance = 0.5;
    EXPECT_EQ(excess(change), 4);
    change.allowance = 0;
    EXPECT_EQ(excess(change), 2e12) << "nothing was allowed";
    change.head = 1;
    EXPECT_EQ(excess(change), 0);
    change.base.reset();
    EXPECT_TRUE(std::isinf(excess(change)));
}

} // namespace
} // namespace shadowbench::gate
