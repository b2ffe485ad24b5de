// What libclang finds for the operators in a source.
#include "tools/mutants/operators/syntax.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench::mutants {
namespace {

const std::vector<std::string> flags{"-std=c++20", "-I" SOURCE_FOLDER};

/// "before → after" of each point that `operation` makes; of a statement, what it is.
std::vector<std::string> found(const std::string& source, const std::string& operation) {
    std::vector<std::string> result;
    for (const Point& point : pointsOf(source, flags))
        if (point.operation == operation)
            result.push_back(source.substr(point.begin, point.end - point.begin) +
                             (point.after.empty() ? "" : " -> " + point.after));
    return result;
}

using Texts = std::vector<std::string>;

TEST(OperatorSyntax, FindsOperatorsOfNumbersAndOfClasses) {
    EXPECT_EQ(found("bool f(int a) { return a < 3; }", "shifted comparison"), Texts{"a < 3 -> a <= 3"});
    EXPECT_EQ(found("#include <string>\nbool f(std::string a) { return a == \"b\"; }", "negated comparison"),
              Texts{"a == \"b\" -> a != \"b\""});
    EXPECT_TRUE(found("#include <string>\nauto f(std::string a) { return a + \"b\"; }", "other sign").empty());
}

TEST(OperatorSyntax, ASizeIsNoDifference) {
    const std::string source = "#include <cmath>\ndouble f(double a, double b) { return std::abs(a - b); }";
    EXPECT_EQ(found(source, "absolute value"), (Texts{"std::abs(a - b) -> a - b", "a - b -> std::abs(a) - std::abs(b)"}));
    EXPECT_TRUE(found(source, "swapped operands").empty());
}

TEST(OperatorSyntax, DropsStatementsThatNothingHangsOn) {
    EXPECT_EQ(
        found("void g(); int f(int a) { if (a) return 1; else g(); for (;;) ++a; g(); return a; }", "dropped statement"),
        (Texts{"g();", "return 1;", "g();", "++a;"}));
}

TEST(OperatorSyntax, LeavesAloneWhatTheCompilerEvaluates) {
    EXPECT_TRUE(pointsOf("constexpr int a = 1; static_assert(1 + 1 == 2); enum { b = 2 + 3 };\n"
                         "constexpr int f() { return 4; } template <int n> int g(); int h() { return g<5>(); }",
                         flags)
                    .empty());
}

TEST(OperatorSyntax, SwapsArgumentsOfOneTypeOnly) {
    EXPECT_EQ(found("int g(int, int, float); int f(int a, int b) { return g(a, b, 1.0f); }", "swapped arguments"),
              Texts{"g(a, b, 1.0f) -> g(b, a, 1.0f)"});
}

TEST(OperatorSyntax, TheSourceWithAllMutantsCompiles) {
    const std::string source = "#include <cmath>\n#include <vector>\n"
                               "double f(const std::vector<double>& v, int n) {\n"
                               "    double sum = 0;\n"
                               "    for (std::size_t i = 0; i < v.size(); ++i)\n"
                               "        if (v[i] > 0.5 && n != 2) sum += std::abs(v[i] - 1);\n"
                               "        else sum = -sum / 2;\n"
                               "    return n == 0 ? sum : sum * 3;\n"
                               "}\n";
    std::vector<Point> points = pointsOf(source, flags);
    EXPECT_GT(points.size(), 25u);
    EXPECT_TRUE(errorsOf(switched(source, points).text, flags).empty());
}

TEST(OperatorSyntax, SaysWhereAnErrorIs) {
    const std::string source = "int f() { return missing; }";
    EXPECT_EQ(errorsOf(source, flags), std::vector<std::size_t>{source.find("missing")});
}

} // namespace
} // namespace shadowbench::mutants
