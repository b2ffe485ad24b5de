#include "base/words.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(DidYouMean, NamesTheNearestWordsFirst) {
    const std::vector<std::string> known{"pcf", "pcss", "vsm", "esm"};
    EXPECT_EQ(didYouMean("pcs", known), " (did you mean \"pcf\" or \"pcss\"?)");
    EXPECT_EQ(didYouMean("temporal-soft", known), "");
    EXPECT_EQ(didYouMean("windmil", {"trees", "windmills"}), " (did you mean \"windmills\"?)");
    EXPECT_EQ(didYouMean(std::string(50'000'000, 'a'), known), ""); // at once
}

enum class Colour { Red, Green };
constexpr Words<Colour, 2> colours{"colour", {{{Colour::Red, "red"}, {Colour::Green, "green"}}}};

TEST(Words, GoThereAndBack) {
    for (const Colour colour : {Colour::Red, Colour::Green}) EXPECT_EQ(colours.named(colours.of(colour)), colour);
}

TEST(Words, AnUnknownOneIsNamedWithItsNearMatchAndAllThereAre) {
    try {
        (void)colours.named("gren");
        FAIL() << "gren is no colour";
    } catch (const BadInput& error) {
        EXPECT_STREQ(error.what(), "there is no colour \"gren\" (did you mean \"green\"?); there are red, green");
    }
}

} // namespace
} // namespace shadowbench
