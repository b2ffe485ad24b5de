// Two headers that define the same qualified type name break the one-definition rule as soon as one program has both; the
// compiler does not notice. So no two headers of the project may.
#include "base/files.h"
#include "tests/tree/layers.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

std::string withoutComments(const std::string& text) {
    static const std::regex comments(R"(//[^\n]*|"(\\.|[^"\\\n])*")");
    return std::regex_replace(text, comments, " ");
}

/// The qualified names of the types (classes, enumerations, aliases) that a header defines; not those inside functions.
std::set<std::string> typesOf(const std::string& header) {
    static const std::regex token(R"(namespace\s+([\w:]+)\s*\{)"
                                  R"(|\b(?:struct|class|union|enum(?:\s+class)?)\s+([\w:]+)\s*(?:final\s*)?(?::[^;{(]*)?\{)"
                                  R"(|\busing\s+(\w+)\s*=)"
                                  R"(|[{}])");
    const std::string text = withoutComments(header);
    std::vector<std::string> scopes; // "" for a function or an initialiser
    std::set<std::string> types;
    const auto qualified = [&](const std::string& name) {
        std::string result;
        for (const std::string& scope : scopes) result += scope + "::";
        return result + name;
    };
    const auto inFunction = [&] { return std::ranges::find(scopes, "") != scopes.end(); };
    for (std::sregex_iterator i(text.begin(), text.end(), token), end; i != end; ++i) {
        const std::smatch& match = *i;
        const bool isType = match[2].matched || match[3].matched;
        if (isType && !inFunction()) types.insert(qualified(match[2].matched ? match[2] : match[3]));
        if (match.str() == "}") {
            if (!scopes.empty()) scopes.pop_back();
        } else if (!match[3].matched) {
            scopes.push_back(match[1].matched ? match[1] : match[2].matched ? match[2] : std::string());
        }
    }
    return types;
}

TEST(TypeNames, AreReadWithTheirNamespacesAndClasses) {
    const std::string header = R"(
namespace a::b {
class Declared;
struct Outer final : Base<int> { // struct Commented {
    enum class Inner : int { One };
    void f() { struct Local { int x; }; }
};
template <typename T> struct Pair { T x{}; };
using Alias = int;
} // namespace a::b
namespace a::c { struct Outer {}; }
)";
    EXPECT_EQ(typesOf(header),
              (std::set<std::string>{"a::b::Outer", "a::b::Outer::Inner", "a::b::Pair", "a::b::Alias", "a::c::Outer"}));
}

/// The inline functions that a header defines outside of classes, as "name(types of parameters)".
std::set<std::string> functionsOf(const std::string& header) {
    static const std::regex function(R"((?:^|\n)inline [^;={(]*?\b(\w+)\(([^)]*)\))");
    static const std::regex nameOrDefault(R"(\s*\b\w*\s*(=[^,]*)?(?=,|$))"), spaces(R"(\s+)");
    const std::string text = withoutComments(header);
    std::set<std::string> functions;
    for (std::sregex_iterator i(text.begin(), text.end(), function), end; i != end; ++i) {
        const std::string types = std::regex_replace((*i)[2].str(), nameOrDefault, "");
        functions.insert((*i)[1].str() + "(" + std::regex_replace(types, spaces, " ") + ")");
    }
    return functions;
}

TEST(FunctionNames, AreReadWithTheTypesOfTheirParameters) {
    EXPECT_EQ(
        functionsOf(
            "inline int f(double side, int pixels = 128) {}\ninline const A& g(const B& b,\n C* c) {}\n  inline int h();"),
        (std::set<std::string>{"f(double, int)", "g(const B&, C*)"}));
}

// Types of parameters keep overloads apart; namespaces are not looked at, as tests use them all.
TEST(FunctionNames, NoTwoHeadersOfTheTestsDefineTheSame) {
    std::map<std::string, std::string> headerOf;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(fs::path(SOURCE_FOLDER) / "tests/support")) {
        if (file.path().extension() != ".h") continue;
        for (const std::string& function : functionsOf(readFile(file.path()))) {
            const auto [known, isNew] = headerOf.try_emplace(function, file.path().filename().string());
            EXPECT_TRUE(isNew) << function << " is defined in " << known->second << " and " << file.path().filename();
        }
    }
    EXPECT_GT(headerOf.size(), 100U); // else they were not found
}

TEST(TypeNames, NoTwoHeadersDefineTheSame) {
    std::map<std::string, std::vector<std::string>> headersOf;
    for (const std::string& folder : layers::roomsOf(layers::readList(fs::path(SOURCE_FOLDER) / "cmake/layers.txt")))
        for (const fs::directory_entry& file : fs::recursive_directory_iterator(fs::path(SOURCE_FOLDER) / folder)) {
            if (file.path().extension() != ".h") continue;
            for (const std::string& type : typesOf(readFile(file.path())))
                headersOf[type].push_back(fs::relative(file.path(), SOURCE_FOLDER).string());
        }
    EXPECT_GT(headersOf.size(), 200U); // else they were not found
    EXPECT_TRUE(headersOf.contains("shadowbench::groundtruth::hard::ExactScene"));
    for (const auto& [type, headers] : headersOf)
        EXPECT_EQ(headers.size(), 1U) << type << " is defined in " << fmt::format("{}", fmt::join(headers, ", "));
}

} // namespace
} // namespace shadowbench
