// The gate's report: the verdict in words, how to see again what is worse, pictures, notes and the slowest parts.
#include "harness/gate/gate.h"
#include "harness/gate/gate_report.h"
#include "harness/gate/verdict.h"

#include <algorithm>
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
        const std::string text = gateReport(result, optionsOf(), "text");
        return text.substr(text.rfind("gate: "));
    };
    EXPECT_EQ(last(resultOf({})), "gate: pass (head decaf, base v1 (c0ffee))\n");
    EXPECT_TRUE(contains(last(resultOf({worse("trees", "pcf")})), "gate: accuracy or stability regression"));
    EXPECT_TRUE(contains(last(resultOf({worse("trees", "pcf", Class::Work)})), "gate: cost regression"));
    GateResult unsure = resultOf({});
    unsure.unjudged = {"pcf on trees was not measured"};
    EXPECT_TRUE(contains(last(unsure), "gate: inconclusive"));
    EXPECT_TRUE(contains(gateReport(unsure, optionsOf(), "text"), "not judged:\n  pcf on trees was not measured\n"));
    EXPECT_TRUE(gateReport(resultOf({}), optionsOf(), "md").starts_with("## shadowbench: pass\n\nHead decaf, base v1"));
}

TEST(GateReport, NamesEachCommandOnceHoweverMuchOfItsCellIsWorse) {
    const GateResult result = resultOf({worse("trees", "pcf"),
                                        worse("trees", "pcf", Class::Edge),
                                        worse("trees", "vsm"),
                                        {"trees", "esm", "m", Class::Leak, 1, 0.5, 0, Direction::Better, "better"}});
    const std::string text = gateReport(result, optionsOf(), "text"), page = gateReport(result, optionsOf(), "md");
    const std::string command = reproduction(result.changes[0], optionsOf());
    EXPECT_TRUE(contains(text, "to see it again:\n  " + command + "\n"));
    EXPECT_EQ(text.find(command), text.rfind(command));
    EXPECT_TRUE(contains(page, "\nto see it again:\n\n* `" + command + "`\n"));
    EXPECT_FALSE(contains(text, "--technique esm"));
}

TEST(GateReport, ShowsThePicturesThatThereAre) {
    GateResult result = resultOf({worse("trees", "pcf")});
    result.pictures = {{"trees", "pcf", "out/head", "", {}, {}}, {"trees", "vsm", "out/head", "out/base", {}, {}}};
    const std::string text = gateReport(result, optionsOf(), "text"), page = gateReport(result, optionsOf(), "md");
    EXPECT_TRUE(contains(text, "  pcf on trees: out/head/{visibility,reference,error}.png\n")) << text;
    EXPECT_TRUE(contains(text, "error}.png out/base/{visibility"));
    EXPECT_TRUE(contains(page, "pcf on trees: [head visibility](out/head/visibility.png) [head reference]")) << page;
    EXPECT_TRUE(contains(page, "[base error](out/base/error.png)"));
}

TEST(GateReport, ListsTheFiveSlowestPartsThatTookASecond) {
    GateResult result = resultOf({});
    result.seconds = 90;
    for (const double seconds : {3.0, 0.4, 7.0, 1.0, 5.0, 6.0, 4.0}) result.times.push_back({"part", seconds});
    const std::string text = gateReport(result, optionsOf(), "text");
    const std::string slowest = text.substr(text.find("slowest parts of 90 s"));
    EXPECT_TRUE(contains(slowest, "7 s  part\n  6 s  part\n  5 s  part\n  4 s  part\n  3 s  part\ngate:")) << slowest;
    result.times = {{"part", 0.4}};
    EXPECT_FALSE(contains(gateReport(result, optionsOf(), "text"), "slowest")) << "nothing took a second";
}

TEST(GateReport, CommandsCanBePastedIntoAShell) {
    GateOptions options = optionsOf("HEAD~1");
    options.externalFiles = {"my engine.toml"};
    Change change = worse("a scene.toml", "external:engine", Class::Instructions);
    EXPECT_EQ(reproduction(change, options), "./bench run --cost instructions --scene 'a scene.toml' --technique "
                                             "external:engine --profile gate --seed 1 --external 'my engine.toml'");
    change.variant = "pcf"; // which needs no other renderer
    EXPECT_FALSE(contains(reproduction(change, options), "--external"));
    change.changeClass = Class::Time;
    EXPECT_TRUE(contains(reproduction(change, options), "--base 'HEAD~1'"));
}

/// One change of each direction.
std::vector<Change> oneOfEach() {
    std::vector<Change> changes;
    for (const Direction direction :
         {Direction::Better, Direction::Same, Direction::Worse, Direction::Unclear, Direction::Unjudged}) {
        changes.push_back(worse("trees", "pcf"));
        changes.back().direction = direction;
        changes.back().sentence = "change " + std::to_string(changes.size());
    }
    return changes;
}

TEST(ChangesReport, ListsTheWorstFirstAndCountsTheRest) {
    EXPECT_EQ(changesReport(oneOfEach(), "text"), "worse      leak          change 3\nnot judged leak          change 5\n"
                                                  "unclear    leak          change 4\nbetter     leak          change 1\n"
                                                  "1 worse, 1 better, 1 the same, 1 unclear, 1 not judged\n");
    EXPECT_EQ(changesReport({}, "text"), "0 worse, 0 better, 0 the same\n");
    const std::string page = changesReport(oneOfEach(), "md");
    EXPECT_TRUE(page.starts_with("**1 worse, 1 better, 1 the same, 1 unclear, 1 not judged**\n")) << page;
    EXPECT_TRUE(contains(page, "\n| not judged | class |\n|---|---|\n| change 5 | leak |\n")) << page;
    EXPECT_FALSE(contains(changesReport({worse("trees", "pcf")}, "md"), "| better |"));
}

TEST(Annotations, WarnOfWhatIsUnclearOrNotJudged) {
    EXPECT_EQ(annotations(oneOfEach()), "::error title=leak is worse::change 3\n::warning title=leak is not judged::change "
                                        "4\n::warning title=leak is not judged::change 5\n");
}

} // namespace
} // namespace shadowbench::gate
