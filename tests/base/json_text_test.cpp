// Limits of JSON that others wrote: our library's copies, comparisons and prints of values go as deep as these do.
#include "base/json_text.h"
#include "base/limits.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

const std::uint64_t deepest = limitOf(Limit::Nesting);

std::string nested(std::size_t levels, const std::string& open, const std::string& close) {
    std::string text;
    for (std::size_t i = 0; i < levels; ++i) text += open;
    for (std::size_t i = 0; i < levels; ++i) text += close;
    return text;
}

std::string members(std::size_t count) {
    std::string text = "{";
    for (std::size_t i = 0; i < count; ++i) text += fmt::format("{}\"{}\":0", i == 0 ? "" : ",", i);
    return text + "}";
}

TEST(BoundedJson, IsTheTextItselfUpToTheLimits) {
    for (const std::string& text : {nested(deepest, "[", "]"), members(largestObject),
                                    "[" + members(largestObject) + "," + members(1) + "]", std::string("no JSON: }]\"\\")})
        EXPECT_EQ(boundedJson(text, "a file"), text);
}

TEST(BoundedJson, RefusesWhatNestsDeeperAndLargerObjects) {
    EXPECT_THROW(boundedJson(nested(deepest + 1, "[", "]"), "a file"), BadInput);
    EXPECT_THROW(boundedJson(nested(1'000'000, "{\"a\":", "}"), "a file"), BadInput);
    EXPECT_THROW(boundedJson("[{}," + members(largestObject + 1) + "]", "a file"), BadInput);
    try {
        boundedJson(nested(deepest + 1, "[", "]"), "a file");
    } catch (const BadInput& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("a file: its lists and objects are nested deeper"))
            << error.what();
    }
}

TEST(BoundedJson, LooksPastTextsInQuotes) {
    const std::string text = R"(["\"[[[", "{{{", "\\", "a:b"])";
    EXPECT_EQ(boundedJson(text, "a file"), text);
    std::string brackets(1000, '[');
    EXPECT_EQ(boundedJson("\"" + brackets + "\"", "a file").size(), 1002U);
    EXPECT_THROW(boundedJson("\"\\\\\"" + brackets, "a file"), BadInput) << "the quotes end before the brackets";
}

TEST(WholeNumber, IsWhatItsTypeHoldsAndNothingElse) {
    EXPECT_EQ(wholeNumber<int>(Json::parse("-7")), -7);
    EXPECT_EQ(wholeNumber<std::uint32_t>(Json::parse("4294967295")), 4294967295U);
    for (const char* text :
         {"1.0", "1e300", "2147483648", "-2147483649", "18446744073709551615", "\"1\"", "true", "null", "[1]"})
        EXPECT_THROW(wholeNumber<int>(Json::parse(text)), BadInput) << text;
    EXPECT_THROW(wholeNumber<std::uint32_t>(Json::parse("-1")), BadInput);
}

} // namespace
} // namespace shadowbench
