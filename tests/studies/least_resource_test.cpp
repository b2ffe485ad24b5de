// The least of a resource, read off records made up for it.
#include "base/error.h"
#include "studies/recommend/least_resource.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench::recommend {
namespace {

Record mapRecord(const std::string& technique, int map, double mismatch) {
    Record record = test::hardRecord();
    record.technique = technique;
    record.variant = fmt::format("{}:map={}", technique, map);
    record.parameters = {{"map", std::to_string(map)}, {"bias", "slope"}};
    record.values["accuracy.mismatch"] = mismatch;
    record.tolerances = {{"mismatch", 0.005}};
    return record;
}

std::vector<Least> leastMaps(const std::vector<Record>& records) {
    return leastAdequate(records, records.front().scene, Resource::MapTexels);
}

TEST(LeastMap, IsTheSmallestFromWhichOnAllAreWithinTolerance) {
    const auto least = leastMaps({mapRecord("sm-uniform", 512, 0.02), mapRecord("sm-uniform", 1024, 0.009),
                                  mapRecord("sm-uniform", 2048, 0.004), mapRecord("sm-uniform", 4096, 0.002)});
    ASSERT_EQ(least.size(), 1U);
    EXPECT_EQ(least[0].variant, "sm-uniform:map=2048");
    EXPECT_EQ(least[0].amount, 2048);
    EXPECT_EQ(least[0].error, 0.004);
}

TEST(LeastMap, IsNotOneThatIsWithinByLuck) {
    const auto least =
        leastMaps({mapRecord("sm-psm", 512, 0.003), mapRecord("sm-psm", 1024, 0.009), mapRecord("sm-psm", 2048, 0.004)});
    ASSERT_EQ(least.size(), 1U);
    EXPECT_EQ(least[0].amount, 2048);
}

TEST(LeastMap, RanksTechniquesAndLeavesOutThoseThatAreNotWithin) {
    const auto least = leastMaps({mapRecord("a", 512, 0.004), mapRecord("a", 1024, 0.002), mapRecord("b", 512, 0.002),
                                  mapRecord("b", 1024, 0.001), mapRecord("c", 512, 0.9), mapRecord("c", 1024, 0.8)});
    ASSERT_EQ(least.size(), 2U);
    EXPECT_EQ(least[0].variant, "b:map=512");
    EXPECT_EQ(least[1].variant, "a:map=512");
}

TEST(LeastMap, IsWithinAllTolerances) {
    std::vector<Record> records{mapRecord("a", 512, 0.002), mapRecord("a", 1024, 0.001)};
    for (Record& record : records) record.tolerances["leak"] = 0.1;
    records[0].values["accuracy.leak"] = 0.2;
    records[1].values["accuracy.leak"] = 0.02;
    EXPECT_EQ(leastMaps(records)[0].amount, 1024);
    records[0].values["accuracy.leak"].reset(); // does not apply, as of a technique that has no labels
    EXPECT_EQ(leastMaps(records)[0].amount, 512);
}

TEST(LeastMap, NeedsTwoSizesOfOneTechnique) {
    EXPECT_THROW(leastMaps({mapRecord("a", 512, 0.001), mapRecord("b", 1024, 0.001)}), BadInput);
}

TEST(Amount, IsTheSideOfAMapAndTheSumOfTaps) {
    EXPECT_EQ(amount(Resource::MapTexels, "map", "512"), 512);
    EXPECT_EQ(amount(Resource::Samples, "taps", "25+49"), 74);
    EXPECT_EQ(amount(Resource::Samples, "n", "64"), 64);
    EXPECT_FALSE(amount(Resource::Samples, "map", "512"));
    EXPECT_FALSE(amount(Resource::Samples, "taps", "many"));
}

TEST(VariantsOver, AmountsCoverTheRange) {
    const auto maps = variantsOver(Resource::MapTexels, {"sm-uniform", "volume-zfail"});
    EXPECT_EQ(maps, (std::vector<std::string>{"sm-uniform:map=256", "sm-uniform:map=512", "sm-uniform", // the default, 1024
                                              "sm-uniform:map=2048", "sm-uniform:map=4096"}));
    const auto taps = variantsOver(Resource::Samples, {"pcss"});
    EXPECT_EQ(taps, (std::vector<std::string>{"pcss", "pcss:taps=32+32", "pcss:taps=25+49"}));
    EXPECT_THROW(variantsOver(Resource::Samples, {"volume-zfail"}), BadInput);
}

TEST(LeastMap, IsOfOneSettingOfTheOtherParameters) {
    std::vector<Record> records{mapRecord("a", 512, 0.001), mapRecord("a", 1024, 0.001), mapRecord("a", 512, 0.9),
                                mapRecord("a", 1024, 0.9)};
    for (const int i : {2, 3}) records[i].parameters[1].second = "none"; // the bias
    const auto least = leastMaps(records);
    ASSERT_EQ(least.size(), 1U);
    EXPECT_EQ(least[0].amount, 512);
}

} // namespace
} // namespace shadowbench::recommend
