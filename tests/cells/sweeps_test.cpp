// Where techniques break as one quantity of a scene moves: the `breaks` and `never_breaks` of every scene, in the gate
// profile.
#include "scene/load/load.h"
#include "studies/sweep/axis.h"
#include "studies/sweep/sweep.h"
#include "tests/support/cell_stage.h"
#include "tests/support/expected_techniques.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

namespace shadowbench {
namespace {

struct Case {
    std::string scene, axis;
    friend bool operator<(const Case& a, const Case& b) { return std::tie(a.scene, a.axis) < std::tie(b.scene, b.axis); }
};

/// How a failing case is printed.
void PrintTo(const Case& sweep, std::ostream* out) { *out << sweep.scene << " over " << sweep.axis; }

/// What a scene says of techniques that are built.
std::vector<BreakExpectation> expectationsOf(const std::string& scene) {
    std::vector<BreakExpectation> expectations = loadScene(scene, Profile::Gate).breaks;
    std::erase_if(expectations, [](const BreakExpectation& e) { return isToCome(idOf(e.technique)); });
    return expectations;
}

std::vector<Case> everyExpectedSweep() {
    std::set<Case> cases;
    for (const std::string& id : builtinScenes())
        for (const BreakExpectation& expected : expectationsOf(id)) cases.insert({id, expected.axis});
    return {cases.begin(), cases.end()};
}

/// The axis' values from harmless to hard, up to the last at which the technique may break first: what lies beyond it
/// decides nothing.
std::vector<double> decidingValues(const Case& sweep, const BreakExpectation& expected) {
    std::vector<double> values = axisNamed(sweep.axis).valuesFor(loadScene(sweep.scene, Profile::Gate));
    if (!expected.between) return values;
    while (values.size() > 1 && (values.back() < expected.between->x || values.back() > expected.between->y))
        values.pop_back();
    return values;
}

/// Techniques that the same values decide are swept together.
std::vector<Record> swept(const Case& tested, const std::vector<BreakExpectation>& expectations) {
    std::map<std::vector<double>, std::vector<std::string>> techniques;
    for (const BreakExpectation& expected : expectations)
        techniques[decidingValues(tested, expected)].push_back(expected.technique);
    std::vector<Record> records;
    for (const auto& [values, together] : techniques) {
        SweepOptions options;
        options.scene = tested.scene;
        options.axis = tested.axis;
        options.techniques = together;
        options.values = values;
        options.cache = testCache().folder();
        options.work = CellWork::LeftOut;
        options.quiet = true;
        std::ranges::move(sweep(options).records, std::back_inserter(records));
    }
    return records;
}

class ExpectedBreaks : public testing::TestWithParam<Case> {};

TEST_P(ExpectedBreaks, LieWhereTheSceneSays) {
    const std::string id = GetParam().scene, axis = GetParam().axis;
    std::vector<BreakExpectation> expectations = expectationsOf(id);
    std::erase_if(expectations, [&](const BreakExpectation& e) { return e.axis != axis; });

    const std::vector<Record> records = swept(GetParam(), expectations);
    for (const Record& record : records)
        EXPECT_NE(record.status, Status::Error) << record.variant << " at " << record.sweep->value << ": " << record.reason;
    for (const BreakExpectation& expected : expectations) {
        const std::string curve = techniques::parseVariant(expected.technique).name;
        const auto record = std::ranges::find_if(records, [&](const Record& r) { return r.sweep->curve == curve; });
        ASSERT_NE(record, records.end()) << curve << " has no parameter " << axis;
        const std::optional<double> point = record->sweep->breakPoint;
        if (!expected.between) {
            EXPECT_FALSE(point) << curve << " breaks at " << *point << ", though " << expected.reason;
            continue;
        }
        ASSERT_TRUE(point) << curve << " has stopped breaking, though " << expected.reason;
        EXPECT_GE(*point, expected.between->x) << curve << ": " << expected.reason;
        EXPECT_LE(*point, expected.between->y) << curve << ": " << expected.reason;
    }
}

std::string caseName(const testing::TestParamInfo<Case>& tested) {
    return testName(tested.param.scene + "_over_" + tested.param.axis);
}

INSTANTIATE_TEST_SUITE_P(Gate, ExpectedBreaks, testing::ValuesIn(everyExpectedSweep()), caseName);

TEST(ExpectedBreaks, AreStatedOfTechniquesThatBehaveDifferentlyOnEveryAxis) {
    std::map<std::string, std::set<std::string>> techniques, outcomes;
    for (const std::string& id : builtinScenes())
        for (const BreakExpectation& expected : loadScene(id, Profile::Gate).breaks) {
            techniques[expected.axis].insert(expected.technique);
            outcomes[expected.axis].insert(expected.between ? fmt::format("{}", expected.between->x) : "never");
        }
    for (const Axis& axis : axes()) {
        EXPECT_GE(techniques[axis.id].size(), 2U) << axis.id;
        EXPECT_GE(outcomes[axis.id].size(), 2U) << axis.id;
    }
}

} // namespace
} // namespace shadowbench
