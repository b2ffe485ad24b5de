// Content hashes, against the values that XXH3's authors publish for no bytes at all.
#include "base/hash.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Hash, OfNoBytesIsThePublishedOne) {
    EXPECT_EQ(hash128("").text(), "99aa06d3014798d86001c324468d497f");
    EXPECT_EQ(hash64(""), 0x2d06800538d394c2U);
}

TEST(Hash, OfPiecesIsThatOfTheWhole) {
    const std::string text(1000, 'x');
    Hasher128 hasher;
    for (std::size_t i = 0; i < text.size(); i += 100) hasher.add(text.data() + i, 100);
    EXPECT_EQ(hasher.digest(), hash128(text));
}

TEST(Hash, ChangesWithTheBytesAndTheSeed) {
    EXPECT_NE(hash128("a"), hash128("b"));
    EXPECT_NE(hash128("a"), hash128("a", 1));
    EXPECT_NE(hash64("a"), hash64("b"));
}

TEST(Hash, TextKeepsLeadingZeros) { EXPECT_EQ((Hash128{1, 0x2a}.text()), "0000000000000001000000000000002a"); }

} // namespace
} // namespace shadowbench
