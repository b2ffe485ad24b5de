// The list of the OpenGL functions that are called (techniques/gl/functions.inc) names no other. One that it lacks does not
// link.
#include "base/files.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

const fs::path root = SOURCE_FOLDER;

std::vector<std::string> listed() {
    static const std::regex line(R"(GL_FUNCTION\((gl\w+)\))");
    const std::string text = readFile(root / "techniques/gl/functions.inc");
    std::vector<std::string> names;
    for (std::sregex_iterator match(text.begin(), text.end(), line); match != std::sregex_iterator(); ++match)
        names.push_back((*match)[1]);
    return names;
}

std::set<std::string> named() {
    static const std::regex word(R"(\bgl[A-Z]\w*)");
    std::set<std::string> names;
    for (const char* folder : {"techniques", "gpu", "tests/techniques"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (entry.path().extension() != ".cpp") continue;
            const std::string text = readFile(entry.path());
            for (std::sregex_iterator match(text.begin(), text.end(), word); match != std::sregex_iterator(); ++match)
                names.insert(match->str());
        }
    return names;
}

TEST(GlFunctions, AreThoseThatAreCalledInAlphabeticalOrder) {
    const std::vector<std::string> names = listed();
    const std::set<std::string> called = named();
    ASSERT_GT(names.size(), 50U);
    EXPECT_TRUE(std::ranges::is_sorted(names));
    for (const std::string& name : names) EXPECT_TRUE(called.contains(name)) << name << " is called nowhere";
}

} // namespace
} // namespace shadowbench
