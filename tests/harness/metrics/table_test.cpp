// What the table of metrics promises to those who read it.
#include "harness/metrics/frames.h"
#include "harness/metrics/values.h"
#include "tests/support/metrics_images.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::metrics {
namespace {

using namespace test;

TEST(MetricsTable, LinesOfOneObjectOfTheRecordStandTogether) {
    std::set<std::string> ended;
    std::string last;
    for (const Metric& line : table) {
        const std::string object(line.path.substr(0, line.path.rfind('.')));
        if (object == last || last.starts_with(object + ".") || object.starts_with(last + ".")) {
            last = object;
            continue;
        }
        EXPECT_TRUE(ended.insert(last).second) << line.path;
        EXPECT_FALSE(ended.contains(object)) << line.path;
        last = object;
    }
}

TEST(MetricsTable, EveryLineSaysWhatTheMetricIsAndInWhichUnit) {
    for (const Metric& line : table) {
        EXPECT_FALSE(line.meaning.empty()) << line.path;
        EXPECT_FALSE(line.unit.empty()) << line.path;
        EXPECT_TRUE(!line.list || line.optional) << line.path << ": a list without numbers is left out";
    }
}

TEST(MetricsTable, IsSearchedByPathAndByNameForBounds) {
    EXPECT_EQ(metricAt("accuracy.leak")->bound, "leak");
    EXPECT_EQ(boundedMetric("edge_error")->path, "accuracy.edge_error.mean");
    EXPECT_EQ(metricAt("accuracy.laek"), nullptr);
    EXPECT_EQ(boundedMetric(""), nullptr) << "though many lines have no such name";
    EXPECT_EQ(std::ranges::count(boundedMetrics(), "convergence"), 1);
}

TEST(MetricsTable, AGroupIsWhatItsPathBeginsWith) {
    EXPECT_EQ(linesOf("aliasing").size(), 3U);
    EXPECT_EQ(linesOf("accuracy.edge_error").size(), 7U);
    EXPECT_TRUE(linesOf("accuracy.edge").empty());
    EXPECT_EQ(linesOf("cost").back().path, "cost.cold.work.passes") << "the end of the table";
}

TEST(Allowance, IsDescribedInWords) {
    EXPECT_EQ(describe(*metricAt("stability.flip_rate")->allowance), "2 compared pixels + 1 %");
    EXPECT_EQ(describe(*metricAt("accuracy.rmse")->allowance), "the truth's own error");
    EXPECT_EQ(describe(*metricAt("accuracy.edge_error.mean")->allowance), "0.002 + 1 %");
    EXPECT_EQ(describe(*metricAt("stability.convergence")->allowance), "1 + 5 %");
    EXPECT_EQ(describe(*metricAt("cost.work.draws")->allowance), "none");
    EXPECT_EQ(describe(*metricAt("accuracy.leak")->allowance), "2 shadowed pixels");
    EXPECT_EQ(describe({.truth = TruthError::Rms, .pixels = 1}), "1 pixel or the truth's own error");
}

TEST(MetricsTable, EveryClassHasANameOfItsOwn) {
    std::set<std::string_view> names;
    for (int c = 0; c <= static_cast<int>(Class::Status); ++c) names.insert(name(static_cast<Class>(c)));
    EXPECT_EQ(names.size(), static_cast<std::size_t>(Class::Status) + 1);
    EXPECT_FALSE(names.contains(""));
    EXPECT_EQ(name(Class::FalseShadow), "false shadow");
}

TEST(MetricsTable, EveryNumberIsJudgedOrSaysWhyNot) {
    for (const Metric& line : table) {
        EXPECT_EQ(line.allowance.has_value(), line.notCompared.empty()) << line.path;
        EXPECT_TRUE(!line.allowance || line.about) << line.path;
    }
}

TEST(MetricValues, AreComputedForAllLinesOfAKindAndNoOthers) {
    const groundtruth::Reference truth = HalfPlane{{1, 0}, 16}.truth(32, 32);
    const Mask mask = everything(truth);
    Values values;
    compute<OfLabels>(ScoredFrame{truth.visibility, truth, mask}, values);
    for (const Metric& line : table)
        EXPECT_EQ(values[line].has_value(), std::holds_alternative<OfLabels>(line.computed)) << line.path;
}

int edgesSearched = 0;
struct TwoNumbers {
    double one = 1, two = 2;
};
TwoNumbers countedSearch(const ScoredFrame&) {
    ++edgesSearched;
    return {};
}

TEST(MetricValues, PartsOfOneResultAreComputedOnce) {
    const groundtruth::Reference truth = HalfPlane{{1, 0}, 4}.truth(8, 8);
    const Mask mask = everything(truth);
    const ScoredFrame frame{truth.visibility, truth, mask};
    Results<ScoredFrame> results(frame);
    EXPECT_EQ((part<countedSearch, &TwoNumbers::one, ScoredFrame>(results)), 1);
    EXPECT_EQ((part<countedSearch, &TwoNumbers::two, ScoredFrame>(results)), 2);
    EXPECT_EQ(edgesSearched, 1);
}

TEST(MetricValues, AListAndAValueCanBeMadeAbsent) {
    Values values;
    EXPECT_FALSE(values.any(linesOf("stability")));
    values.list("stability.by_frame.rmse") = {0.1, 0.2};
    EXPECT_TRUE(values.any(linesOf("stability")));
    values.clear(*metricAt("stability.by_frame.rmse"));
    EXPECT_FALSE(values.any(linesOf("stability")));
    values["stability.moving_rmse"] = 0.1;
    EXPECT_TRUE(values.any(linesOf("stability"))) << "alone, too";
    EXPECT_EQ(bounded(values, "moving_rmse"), 0.1);
    EXPECT_FALSE(bounded(values, "moving_rms"));
}

} // namespace
} // namespace shadowbench::metrics
