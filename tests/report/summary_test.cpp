// What tables say of single figures, at the places where it changes.
#include "report/summary.h"

#include "report/run_report.h"
#include "report/terminal_summary.h"
#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

namespace shadowbench::report {
namespace {

using namespace test;

constexpr const char* scene = "dueling-frusta";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Dominates, NeedsOneOfErrorAndCostBetterAndTheOtherNotWorse) {
    EXPECT_FALSE(dominates({0.1, 1}, {0.1, 1}));
    EXPECT_TRUE(dominates({0.1, 1}, {0.1, 2}));
    EXPECT_FALSE(dominates({0.1, 2}, {0.1, 1}));
    EXPECT_TRUE(dominates({0.1, 1}, {0.2, 1}));
    EXPECT_FALSE(dominates({0.2, 1}, {0.1, 1}));
    EXPECT_FALSE(dominates({0.2, 1}, {0.1, 2}));
    EXPECT_FALSE(dominates({0.1, 2}, {0.2, 1}));
}

TEST(Dominates, CountsIntervalsThatTouchAsOneCost) {
    const Place low{0.1, 1, 0.5}, high{0.1, 2, 0.25}; // both reach 1.5
    EXPECT_FALSE(dominates(low, high));
    EXPECT_TRUE(dominates(low, {0.1, 2.125, 0.25}));
    EXPECT_TRUE(dominates({0.05, 2, 0.25}, low)) << "not dearer";
    EXPECT_FALSE(dominates({0.05, 2.125, 0.25}, low));
    EXPECT_FALSE(dominates({0.1, 1}, {0.1, 2, 0.75})) << "the other's interval counts as well";
    EXPECT_FALSE(dominates({0.1, 1, 0.75}, {0.1, 1.5}));
    EXPECT_TRUE(dominates({0.05, 2, 0.75}, {0.1, 1}));
    EXPECT_TRUE(dominates({0.05, 1.5}, {0.1, 1, 0.75}));
}

double spreadOf(std::vector<double> samples) {
    Record record = hardCell("a", 0, 1);
    record.values.list("cost.time.samples") = std::move(samples);
    return standingCost(record)->spread;
}

TEST(StandingCost, HasTheIntervalOfTheMedianOfItsRounds) {
    EXPECT_EQ(spreadOf({4}), 0);
    EXPECT_DOUBLE_EQ(spreadOf({1, 2, 3, 4, 5}), 0.5 * (5 - 1) / 3) << "their range";
    EXPECT_DOUBLE_EQ(spreadOf({6, 2, 3, 4, 5, 1}), 0.5 * (6 - 1) / 3.5);
    EXPECT_DOUBLE_EQ(spreadOf({1, 2, 3, 4, 5, 6, 9}), 0.5 * (9 - 1) / 4);
    EXPECT_DOUBLE_EQ(spreadOf({1, 2, 4, 7, 11, 16, 22, 29, 37, 46, 56, 67}), 0.5 * (46 - 4) / 19);
}

TEST(FrameCost, InMotionIsTakenWhereTheIntervalsLieApart) {
    Record record = hardCell("a", 0, 1);
    record.values["cost.motion.time.ratio"] = 2;
    record.values.list("cost.time.samples") = {24, 32, 32, 32, 32, 40};        // 1 ± 0.25
    record.values.list("cost.motion.time.samples") = {20, 32, 32, 32, 32, 44}; // 2 ± 0.75: they meet
    EXPECT_NEAR(frameCost(record)->ratio, 1, 1e-12);
    record.values["cost.motion.time.ratio"] = 2.01;
    EXPECT_NEAR(frameCost(record)->ratio, 2.01, 1e-12);
    EXPECT_NEAR(frameCost(record)->spread, 0.375, 1e-12);
}

TEST(FrameCost, IsNotTakenFromOtherRenderers) {
    Record record = hardCell("external:engine", 0, 1);
    record.values["cost.motion.time.ratio"] = 2;
    EXPECT_TRUE(knowsMotion(record));
    record.technique = "external:engine";
    EXPECT_FALSE(knowsMotion(record));
    EXPECT_FALSE(standingCost(record));
    EXPECT_FALSE(frameCost(record));
}

TEST(Standing, ForgetsWhatIsKnownOfMotion) {
    Record record = hardCell("a", 0, 1);
    record.values["cost.motion.time.ratio"] = 2;
    record.motionPasses = record.passes;
    const Record still = standing({record}).front();
    EXPECT_FALSE(knowsMotion(still));
    EXPECT_TRUE(still.motionPasses.empty());
    EXPECT_EQ(still.values["cost.time.ratio"], 1);
}

TEST(Percent, HasAsManyDigitsAsTellSharesApart) {
    EXPECT_EQ(percent(0), "0.00 %");
    EXPECT_EQ(percent(0.00004), "< 0.01 %");
    EXPECT_EQ(percent(0.00006), "0.01 %");
    EXPECT_EQ(percent(0.0049), "0.49 %");
    EXPECT_EQ(percent(0.0999), "9.99 %");
    EXPECT_EQ(percent(0.1), "10.0 %");
    EXPECT_EQ(percent(0.999), "99.9 %");
    EXPECT_EQ(percent(0.9996), "100 %");
    EXPECT_EQ(percent(1), "100 %");
    EXPECT_EQ(percent(-0.01), "-1.00 %");
}

TEST(ErrorText, NamesIntervalAndWorstView) {
    Record record = hardCell("a", 0.0054, 1);
    EXPECT_EQ(errorText(record), "0.54 %");
    record.values["views.worst"] = 0.0071;
    EXPECT_EQ(errorText(record), "0.54 %, worst 0.71 %");
    record.values["stability.seeds.interval"] = 0.0003;
    EXPECT_EQ(errorText(record), "0.54 % ± 0.03 %, worst 0.71 %");
}

TEST(ExactError, IsTheOneOfTheTruthThatKnowsTheExactShare) {
    Record record = softCell("pcss", 0.03, 1);
    EXPECT_FALSE(exactError(record));
    record.softReference = record.reference;
    record.softReference->area = AreaInfo{"a", "b", 0.004, 0.02};
    EXPECT_EQ(exactError(record), 0.02);
    record.reference->area = AreaInfo{"a", "b", 0.004, 0.01};
    EXPECT_EQ(exactError(record), 0.01);
    Record hard = hardCell("a", 0.1, 1); // its headline is not against samples of the light
    hard.reference->area = AreaInfo{"a", "b", 0.004, 0.01};
    EXPECT_FALSE(exactError(hard));
}

TEST(Tolerances, AreThoseOfTheFirstRecordThatStatesAny) {
    std::vector<Record> records = {hardCell("a", 0, 1), hardCell("b", 0, 1), hardCell("c", 0, 1), softCell("d", 0, 1)};
    records[0].tolerances.clear();
    records[1].tolerances = {{"leak", 0.25}, {"mismatch", 0.5}};
    records[2].tolerances = {{"mismatch", 0.125}};
    EXPECT_EQ(tolerance(records, scene)->metric, "leak");
    EXPECT_EQ(formatBounds(tolerances(records, scene)), "leak 25 %, mismatch 50 %, false_shadow 2 %, missing_edges 5 %")
        << "those of the shadow itself hold unless the scene states its own";
    EXPECT_FALSE(tolerance({records[0]}, scene));
}

TEST(Tolerances, OfASceneThatStatesNoneAreTheUsualOnesOfItsLight) {
    Record hard = hardCell("a", 0, 1), soft = softCell("a", 0, 1);
    hard.tolerances.clear();
    soft.tolerances.clear();
    EXPECT_EQ(formatBounds(tolerances({hard}, hard.scene)), "mismatch 2 %, leak 5 %, false_shadow 2 %, missing_edges 5 %");
    EXPECT_EQ(formatBounds(tolerances({soft}, soft.scene)), "penumbra_rmse 0.05, rmse 0.03, umbra_leak 0.05");
    EXPECT_TRUE(tolerances({unscored(Status::Error, "")}, "nowhere").empty());
}

TEST(IsWithin, HoldsUpToTheToleranceItselfOfAScoredRecord) {
    const std::vector<Tolerance> limits = {{"leak", 0.5}, {"mismatch", 0.25}};
    Record record = hardCell("a", 0.25, 1);
    record.values["accuracy.leak"] = 0.125;
    EXPECT_EQ(shareOfTolerance(record, limits), 1);
    EXPECT_TRUE(isWithin(record, limits));
    EXPECT_FALSE(isWithin(record, {}));
    record.values["accuracy.leak"] = 1;
    EXPECT_EQ(shareOfTolerance(record, limits), 2) << "the worst decides";
    EXPECT_FALSE(isWithin(record, limits));
    Record failed = hardCell("a", 0.1, 1);
    failed.status = Status::Error;
    EXPECT_FALSE(isWithin(failed, limits));
}

TEST(FrontMark, IsFullUpToTenTimesTheTolerance) {
    std::vector<Record> records = {hardCell("a", 0.625, 1)};
    records[0].tolerances = {{"mismatch", 0.0625}};
    EXPECT_EQ(frontMark(records, scene, 0), "●");
    records[0].values["accuracy.mismatch"] = 0.6875;
    EXPECT_EQ(frontMark(records, scene, 0), "○");
    records[0].tolerances.clear();
    EXPECT_EQ(frontMark(records, scene, 0), "○") << "the usual tolerance is 2 %";
}

TEST(ParetoFront, ListsEqualCostsInTheOrderOfTheRecords) {
    const std::vector<Record> records = {hardCell("b", 0.1, 1), hardCell("dear", 0.01, 2), hardCell("a", 0.1, 1)};
    EXPECT_EQ(paretoFront(records, scene), (std::vector<std::size_t>{0, 2, 1}));
}

TEST(Scenes, AreNamedOnceInTheirOrder) {
    const std::vector<Record> records = {softCell("a", 0, 1), hardCell("b", 0, 1), softCell("c", 0, 1)};
    EXPECT_EQ(scenes(records), (std::vector<std::string>{"overlapping-occluders", "dueling-frusta"}));
    EXPECT_EQ(ofScene(records, "overlapping-occluders"), (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(variantsOf(records, {0, 2}), "a, c");
}

TEST(ScoredOf, LeavesOutWhatHasNoHeadline) {
    const std::vector<Record> records = {unscored(Status::NotApplicable, "x"), hardCell("b", 0, 1)};
    EXPECT_EQ(scoredOf(records, scene), std::vector<std::size_t>{1});
    EXPECT_EQ(headlineMetric(records, scene), "mismatch");
    EXPECT_EQ(headlineMetric({records[0]}, scene), "");
}

TEST(Meaning, OfMetricsIsInWords) {
    EXPECT_EQ(meaning("mismatch"), "mismatching pixels");
    EXPECT_EQ(meaning("rmse"), "rms error of visibility");
    EXPECT_EQ(meaning("pop"), "pop");
    EXPECT_TRUE(isShare("mismatch"));
    EXPECT_FALSE(isShare("rmse"));
    EXPECT_FALSE(isShare("no-such-metric"));
}

TEST(ReportedCosts, NameTheDeviceWhereItIsKnown) {
    std::vector<Record> records = hardScene();
    EXPECT_EQ(reportedCosts(records, scene), "");
    records[0].external = {.title = "", .source = "", .reported = ReportedCost{1.25, "a GPU"}};
    records[1].external = ExternalInfo{};
    records[2].external = {.title = "", .source = "", .reported = ReportedCost{2.5, ""}};
    EXPECT_EQ(reportedCosts(records, scene), "none 1.25 ms (a GPU), sm-history:base=lispsm 2.5 ms");
}

TEST(Truth, SaysByWhomItIsAndHowUncertain) {
    ReferenceInfo info{"polygon", "feed", 0, 0, {}};
    EXPECT_EQ(truth(info), "exact (polygon)");
    info.sigma = 0.0006;
    EXPECT_EQ(truth(info), "exact (polygon), σ 0.0006");
    info.oracle = "povray";
    info.samples = 64;
    EXPECT_EQ(truth(info), "POV-Ray 64 samples, σ 0.0006");
}

TEST(Texts, OfSizesAndForMarkdown) {
    Record record = hardCell("a", 0, 1);
    EXPECT_EQ(imageSize(record), "256²");
    record.width = 800;
    EXPECT_EQ(imageSize(record), "800 × 256");
    EXPECT_EQ(markdownText("a|b*c_d<e>f`g\\h"), "a\\|b\\*c\\_d\\<e\\>f\\`g\\\\h");
}

TEST(Table, NamesRenderersDoubtfulRowsAndExpectedFailures) {
    std::vector<Record> records = {hardCell("doubt", 0.1, 1), hardCell("fails", 0.2, 1), hardCell("external:x", 0.3, 1),
                                   hardCell("external:y", 0.4, 1), hardCell("external:z", 0.4, 1)};
    records[0].values["sanity.times_none"] = 3;
    records[1].status = Status::ExpectedFailure;
    records[2].external = {.title = "X", .source = "version 4", .reported = {}};
    records[3].external = {.title = "", .source = "version 5", .reported = {}};
    records[4].external = ExternalInfo{};
    const std::string page = markdownTable(records, scene);
    EXPECT_TRUE(contains(page, "| doubt (doubtful) |")) << page;
    EXPECT_TRUE(contains(page, "\ndoubtful: doubt (worse than no shadow: 3 times its error)\n")) << page;
    EXPECT_TRUE(contains(page, "| fails (fails as expected) |")) << page;
    EXPECT_TRUE(contains(page, "\nexternal:x: X (version 4)\n")) << page;
    EXPECT_TRUE(contains(page, "\nexternal:y: version 5\n")) << page;
    EXPECT_FALSE(contains(page, "\nexternal:z:")) << page;
}

TEST(Table, JoinsWhatDoesNotApplyForOneReason) {
    std::vector<Record> records = {hardCell("a", 0.1, 1), unscored(Status::NotApplicable, "needs an area light"),
                                   unscored(Status::NotApplicable, "needs a plane"),
                                   unscored(Status::NotApplicable, "needs an area light")};
    records[1].variant = "b";
    records[2].variant = "c";
    records[3].variant = "d";
    const std::string table = terminalTable(records, scene);
    EXPECT_TRUE(contains(table, " not applicable: b, d (needs an area light)\n not applicable: c (needs a plane)\n"))
        << table;
}

TEST(TerminalSummary, CountsErrorsBesideWhatDoesNotApply) {
    std::vector<Record> records = {hardCell("a", 0.1, 1), unscored(Status::NotApplicable, "x"), unscored(Status::Error, "y"),
                                   unscored(Status::Error, "z")};
    EXPECT_TRUE(contains(terminalSummary(records, scene, "page.md"),
                         "Pareto front: 1 of 1 techniques; not applicable: 1; errors: 2; the full table: page.md\n"));
    EXPECT_EQ(terminalSummary({}, scene, "page.md"), "");
}

TEST(TerminalSummary, PutsTheCheapestBehindRowsOfItsCost) {
    std::vector<Record> records = {hardCell("front", 0.0625, 1), hardCell("adequate", 0.0625, 2), hardCell("dear", 0, 3)};
    records[0].values["accuracy.leak"] = 1;
    for (Record& record : records) record.tolerances = {{"leak", 0.5}};
    records[1].values["accuracy.leak"] = 0.25;
    const std::string text = terminalSummary(records, scene, "page.md");
    EXPECT_LT(text.find("\n front"), text.find("\n adequate"));
    EXPECT_LT(text.find("\n adequate"), text.find("\n dear"));
    EXPECT_TRUE(contains(text, "Pareto front: 3 of 3 techniques"));
}

} // namespace
} // namespace shadowbench::report
