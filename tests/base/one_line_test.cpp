// What is wrong with an input is said on one line, whatever the input holds.
#include "base/one_line.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(OneLine, DoesNothingToATerminal) {
    EXPECT_EQ(onOneLine("unknown key \"a\nb\x1b[31m\x7f\"; remove it"), "unknown key \"a b [31m \"; remove it");
    EXPECT_EQ(onOneLine("ε = 1 is no number"), "ε = 1 is no number");
}

TEST(OneLine, IsNoLongerThanSomeScreensAndCutBetweenCharacters) {
    std::string text = "a";
    while (text.size() < 100'000) text += "ε";
    const std::string cut = onOneLine(text);
    EXPECT_LT(cut.size(), 10'000U);
    EXPECT_TRUE(cut.ends_with("ε…"));
    EXPECT_EQ(cut.find("ε…"), cut.size() - 5);
}

} // namespace
} // namespace shadowbench
