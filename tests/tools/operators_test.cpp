// The operators' mutants, and the switch between them and the source.
#include "tools/mutants/operators/operations.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "tools/mutants/operators/suite.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench::mutants {
namespace {

constexpr std::size_t headingLength = std::string_view("#include \"tools/mutants/operators/active.h\"\n#line 1\n").size();

std::string switchedBody(std::string_view source, std::vector<Point> points) {
    return switched(source, std::move(points)).text.substr(headingLength);
}

/// "operation: after" of each.
std::vector<std::string> describe(const std::vector<Change>& changes) {
    std::vector<std::string> result;
    for (const Change& change : changes) result.push_back(change.operation + ": " + change.after);
    return result;
}

using Texts = std::vector<std::string>;

TEST(Operators, AComparisonIsNegatedAndShifted) {
    EXPECT_EQ(describe(changesOfBinary("a", "<", "b", Values::Unsigned, true)),
              (Texts{"negated comparison: a >= b", "shifted comparison: a <= b"}));
    EXPECT_EQ(describe(changesOfBinary("a", "==", "b", Values::Unsigned, true)), (Texts{"negated comparison: a != b"}));
}

TEST(Operators, OfAConditionEachTermIsDropped) {
    EXPECT_EQ(describe(changesOfBinary("a", "&&", "b", Values::Unsigned, true)),
              (Texts{"dropped term: static_cast<bool>(a)", "dropped term: static_cast<bool>(b)"}));
}

TEST(Operators, ADifferenceLosesItsSignAsWell) {
    EXPECT_EQ(describe(changesOfBinary("a", "-", "b", Values::Floating, true)),
              (Texts{"dropped term: a", "swapped operands: b - a", "absolute value: std::abs(a - b)",
                     "absolute value: std::abs(a) - std::abs(b)"}));
    EXPECT_EQ(describe(changesOfBinary("a", "-", "b", Values::Unsigned, true)),
              (Texts{"dropped term: a", "swapped operands: b - a"}));
}

TEST(Operators, AProductOfRealNumbersIsATenthAsLarge) {
    EXPECT_EQ(describe(changesOfBinary("a", "*", "b", Values::Floating, true)),
              (Texts{"dropped term: a", "a tenth: a * b * 0.1f"}));
    EXPECT_EQ(describe(changesOfBinary("a", "*", "b", Values::Vector, false)), Texts{});
}

TEST(Operators, TextsAreNotSubtracted) { EXPECT_TRUE(changesOfBinary("a", "+", "b", Values::Other, true).empty()); }

TEST(Operators, ConstantsChange) {
    EXPECT_EQ(describe(changesOfLiteral("0", Values::Signed)), Texts{"changed constant: 0 + 1"});
    EXPECT_EQ(describe(changesOfLiteral("0.5f", Values::Floating)), Texts{"changed constant: 2 * 0.5f"});
    EXPECT_EQ(describe(changesOfLiteral("0.0", Values::Floating)), Texts{"changed constant: 0.0 + 1"});
    EXPECT_EQ(describe(changesOfLiteral("true", Values::Unsigned)), Texts{"changed constant: false"});
}

TEST(Operators, ArgumentsOfOneTypeAreSwappedWhereTheirOrderCounts) {
    EXPECT_EQ(describe(changesOfCall("f", {"a", "b", "c"}, {true, false, false}, Values::Other, false)),
              Texts{"swapped arguments: f(b, a, c)"});
    EXPECT_EQ(describe(changesOfCall("std::min", {"a", "b"}, {true, false}, Values::Signed, true)),
              Texts{"other function: std::max(a, b)"});
    EXPECT_EQ(describe(changesOfCall("std::abs", {"a"}, {false}, Values::Floating, true)), Texts{"absolute value: a"});
}

TEST(Operators, TheSwitchHoldsOuterAndInnerMutants) {
    EXPECT_EQ(switchedBody("x = a + b;", {{4, 9, "dropped term", "a", 1}, {8, 9, "other", "c", 2}}),
              "x = (::mutants::active(1) ? (a) : (a + (::mutants::active(2) ? (c) : (b))));");
    EXPECT_EQ(switchedBody("y(1);z();", {{0, 5, "dropped statement", "", 3}, {5, 9, "dropped statement", "", 4}}),
              "{ if (!::mutants::active(3)) y(1); }{ if (!::mutants::active(4)) z(); }");
    EXPECT_EQ(switchedBody("a", {{0, 1, "one", "b", 1}, {0, 1, "other", "c", 2}}),
              "(::mutants::active(1) ? (b) : ((::mutants::active(2) ? (c) : (a))))");
}

TEST(Operators, AnErrorIsOfTheInnermostMutant) {
    const Switched planted = switched("x = a + b;", {{4, 9, "dropped term", "a", 1}, {8, 9, "other", "c", 2}});
    EXPECT_EQ(planted.around(planted.text.find("(a)")), 1);
    EXPECT_EQ(planted.around(planted.text.find("(c)")), 2);
    EXPECT_EQ(planted.around(planted.text.find("x =")), std::nullopt);
}

TEST(Operators, AnIdHangsOnItsLineAlone) {
    const std::string line = "return a < b;", other = "int c = 0;\n";
    const auto ids = [](const std::string& source, std::size_t begin) {
        return mutantsOf(0, "a.cpp", source, {{begin, begin + 5, "negated comparison", "a >= b", 1}}).front();
    };
    EXPECT_EQ(ids(line, 7).id, ids(other + "  " + line, other.size() + 9).id);
    EXPECT_EQ(ids(other + line, other.size() + 7).line, 2u);
    EXPECT_EQ(ids(line, 7).before, "a < b");
    const Point point{7, 12, "negated comparison", "a >= b", 1};
    const std::vector<OperatorMutant> twice = mutantsOf(0, "a.cpp", line, {point, point});
    EXPECT_NE(twice[0].id, twice[1].id);
}

TEST(Operators, WhatTheSeedDrawsFirstStaysFirstWhenOthersGo) {
    std::vector<OperatorMutant> all;
    for (const char* id : {"a", "b", "c", "d", "e"}) all.emplace_back().id = id;
    std::vector<OperatorMutant> some = all;
    shuffle(all, 1);
    some.erase(some.begin() + 2);
    shuffle(some, 1);
    std::erase_if(all, [](const OperatorMutant& m) { return m.id == "c"; });
    EXPECT_TRUE(std::ranges::equal(all, some, {}, &OperatorMutant::id, &OperatorMutant::id));
}

TEST(Operators, TheReportCountsAndExplainsSurvivors) {
    std::vector<OperatorMutant> mutants(4);
    mutants[0].end = End::Killed;
    mutants[1].end = End::Survives;
    mutants[1].id = "1a";
    mutants[2].id = "2b";
    mutants[3].end = End::Killed;
    EXPECT_DOUBLE_EQ(killedShare(mutants), 0.5);
    const std::string report = operatorsReport(mutants, {{"1a", "it is equal"}}, "seed 1");
    EXPECT_NE(
        report.find("50.0 % of 4 mutants are killed by the unit tests of the part that they change; of those without a "
                    "reason below, 66.7 %."),
        std::string::npos)
        << report;
    EXPECT_NE(report.find("| metrics | 4 | 2 | 1 | 50.0 % |"), std::string::npos);
    EXPECT_NE(report.find("it is equal"), std::string::npos);
    EXPECT_NE(report.find("no test reaches it; **not explained**"), std::string::npos);
}

TEST(Operators, ReasonsAreSentences) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "list.toml", "1a = 'so'\n");
    EXPECT_EQ(readSurvivors(folder.path() / "list.toml").at("1a"), "so");
    writeFile(folder.path() / "list.toml", "1a = 2\n");
    EXPECT_THROW(readSurvivors(folder.path() / "list.toml"), BadInput);
    writeFile(folder.path() / "list.toml", "1a\n");
    EXPECT_THROW(readSurvivors(folder.path() / "list.toml"), BadInput);
}

} // namespace
} // namespace shadowbench::mutants
