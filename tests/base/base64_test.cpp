#include "base/base64.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// RFC 4648, section 10.
TEST(Base64, HasTheStandardsTestVectors) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    for (const std::string bytes : {"", "f", "fo", "foo", "foob", "fooba", "foobar"})
        EXPECT_EQ(fromBase64(base64(bytes)), bytes);
}

TEST(Base64, IsReadWithAndWithoutPaddingAndNothingElseIs) {
    EXPECT_EQ(fromBase64("Zg"), "f");
    EXPECT_EQ(fromBase64("//4"), "\xFF\xFE");
    for (const char* text : {"Z", "Zm9vY", "Zm9v YmFy", "Zg===", "=Zg=", "Zm-_"}) EXPECT_FALSE(fromBase64(text)) << text;
}

TEST(Base64, HasEveryLetterOfTheAlphabetAndTakesEveryByte) {
    std::string bytes;
    for (const unsigned byte :
         {0x00U, 0x10U, 0x83U, 0x10U, 0x51U, 0x87U, 0x20U, 0x92U, 0x8BU, 0x30U, 0xD3U, 0x8FU, 0x41U, 0x14U, 0x93U, 0x51U,
          0x55U, 0x97U, 0x61U, 0x96U, 0x9BU, 0x71U, 0xD7U, 0x9FU, 0x82U, 0x18U, 0xA3U, 0x92U, 0x59U, 0xA7U, 0xA2U, 0x9AU,
          0xABU, 0xB2U, 0xDBU, 0xAFU, 0xC3U, 0x1CU, 0xB3U, 0xD3U, 0x5DU, 0xB7U, 0xE3U, 0x9EU, 0xBBU, 0xF3U, 0xDFU, 0xBFU})
        bytes += static_cast<char>(byte);
    EXPECT_EQ(base64(bytes), "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/");
    EXPECT_EQ(fromBase64(base64(bytes)), bytes);
    EXPECT_EQ(base64(std::string(3, '\0')), "AAAA");
    EXPECT_EQ(base64("\xFF\xFE"), "//4=");
}

} // namespace
} // namespace shadowbench
