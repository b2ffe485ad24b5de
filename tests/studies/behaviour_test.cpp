// The table of strengths and failures: every technique is in it, and what it names is there.
#include "base/error.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "studies/behaviour/behaviour.h"
#include "techniques/catalog.h"
#include "tests/support/message_of.h"
#include "tests/support/records_examples.h"
#include "tests/support/tests_of_the_tree.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {

TEST(Behaviours, AreThoseOfTheCatalogueInItsOrder) {
    std::vector<std::string> ids, catalogue;
    for (const Behaviour& behaviour : behaviours()) ids.push_back(behaviour.technique);
    for (const techniques::Entry& entry : techniques::catalog()) catalogue.push_back(entry.id);
    EXPECT_EQ(ids, catalogue);
}

TEST(Behaviours, NameTestsScenesVariantsAndMetricsThatExist) {
    const std::set<std::string> tests = testsOfTheTree();
    ASSERT_GT(tests.size(), 500U); // else the pattern no longer finds them
    const std::vector<std::string> scenes = builtinScenes();
    for (const Behaviour& behaviour : behaviours()) {
        for (const Asserted* asserted : {&behaviour.strength, &behaviour.failure}) {
            SCOPED_TRACE(behaviour.technique + ": " + asserted->says);
            EXPECT_TRUE(tests.contains(asserted->test)) << asserted->test;
            EXPECT_NE(std::ranges::find(scenes, asserted->scene), scenes.end()) << asserted->scene;
            const techniques::Variant variant = techniques::parseVariant(asserted->variant);
            EXPECT_EQ(variant.name, asserted->variant);
            EXPECT_EQ(variant.entry->id, behaviour.technique);
            const std::string path = asserted->metric.substr(0, asserted->metric.find('['));
            const auto isFigure = [&](const techniques::Figure& figure) { return "figures." + figure.name == path; };
            EXPECT_TRUE(metrics::metricAt(path) != nullptr || std::ranges::any_of(variant.entry->figures, isFigure)) << path;
        }
    }
}

const std::string one = R"([{"technique": "sm-uniform",
    "strength": {"says": "a_b", "test": "Suite.Name", "scene": "s", "metric": "accuracy.mismatch"},
    "failure": {"says": "c & d", "test": "Suite.Other", "scene": "s", "variant": "sm-uniform:bias=none",
                "metric": "stability.by_frame.rmse[2]"}}])";

TEST(Behaviours, WithoutATechniqueAreRejectedWithTheSentenceThatSaysSo) {
    EXPECT_NE(test::messageOf([] { parseBehaviours(R"([{"strength": {}, "failure": {}}])"); }).find("one without technique"),
              std::string::npos);
    EXPECT_NE(test::messageOf([] { parseBehaviours(R"([{"technique": 1}])"); }).find("one without technique"),
              std::string::npos);
}

TEST(BehaviourTable, HasTheFiguresOfTheRecords) {
    Record record = test::hardRecord();
    record.scene = "s";
    record.variant = "sm-uniform";
    record.values["accuracy.mismatch"] = 0.0123;
    const std::string text = behaviourTable(parseBehaviours(one), {record}, Markup::Markdown);
    EXPECT_NE(text.find("| sm-uniform | "), std::string::npos) << text;
    EXPECT_NE(text.find("| a\\_b | Suite.Name | s | mismatch 1.23 % | c & d | Suite.Other | s (sm-uniform:bias=none) | "
                        "rmse[2] – |"),
              std::string::npos)
        << text;
}

TEST(BehaviourTable, WritesTenThousandAndMoreInFull) {
    std::string json = one;
    json.replace(json.find("accuracy.mismatch"), 17, "cost.time.median");
    const auto figure = [&](double ms) {
        Record record = test::hardRecord();
        record.scene = "s";
        record.variant = "sm-uniform";
        record.values["cost.time.median"] = ms;
        const std::string text = behaviourTable(parseBehaviours(json), {record}, Markup::Markdown);
        const std::size_t start = text.find("| s | ") + 6;
        return text.substr(start, text.find(" |", start) - start);
    };
    EXPECT_EQ(figure(12345), "time.median 12345");
    EXPECT_EQ(figure(9876), "time.median 9.88e+03");
}

TEST(BehaviourTable, IsEscapedForLatex) {
    const std::string text = behaviourTable(parseBehaviours(one), {}, Markup::Latex);
    EXPECT_NE(text.find("a\\_b & Suite.\\allowbreak{}Name & s & mismatch –"), std::string::npos) << text;
    EXPECT_NE(text.find("c \\& d"), std::string::npos) << text;
    EXPECT_NE(text.find("\\toprule"), std::string::npos);
    EXPECT_NE(text.find("\\bottomrule"), std::string::npos);
}

TEST(Behaviours, MistakesNameTechniqueAndKey) {
    const auto message = [](const std::string& json) -> std::string {
        try {
            parseBehaviours(json);
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message("{}"), "reading behaviours: not a JSON list");
    EXPECT_EQ(message(R"([{"technique": "pcf", "weakness": {}}])"), "reading behaviours: pcf: \"weakness\" is no key");
}

} // namespace
} // namespace shadowbench
