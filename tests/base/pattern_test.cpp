#include "base/pattern.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace shadowbench {
namespace {

TEST(Pattern, GivesTheFirstMatchAndItsGroups) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(firstMatch("0:12(3): error: no x", "^0:([0-9]+)\\([0-9]+\\)(.*)$"),
              (Words{"0:12(3): error: no x", "12", ": error: no x"}));
    EXPECT_EQ(firstMatch("ab12cd34", "[0-9]+"), Words{"12"});
    EXPECT_EQ(firstMatch("b", "(a)?b"), (Words{"b", ""}));
    EXPECT_EQ(firstMatch("uniform vec2 half_size;", "\\buniform\\b.*\\bhalf\\b"), Words{});
    EXPECT_EQ(firstMatch(std::string(1000000, 'x') + "y", "x*y").front().size(), 1000001);
    EXPECT_THROW(firstMatch("a", "(a"), std::invalid_argument);
}

} // namespace
} // namespace shadowbench
