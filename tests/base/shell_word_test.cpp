#include "base/shell_word.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(ShellWord, IsQuotedWhereAShellWouldReadMoreIntoIt) {
    EXPECT_EQ(shellWord("pcss:taps=32+32,map=512"), "pcss:taps=32+32,map=512");
    EXPECT_EQ(shellWord("results/a.jsonl"), "results/a.jsonl");
    EXPECT_EQ(shellWord("sm-*"), "'sm-*'");
    EXPECT_EQ(shellWord(""), "''");
    EXPECT_EQ(shellWord("it's mine"), "'it'\\''s mine'");
}

} // namespace
} // namespace shadowbench
