// Records of older programs: what they lack may be absent, and what nothing reads any more is passed over.
#include "base/error.h"
#include "base/files.h"
#include "tests/support/records_examples.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench {
namespace {

using namespace test;
using Json = nlohmann::ordered_json;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(OlderRecords, AreReadWithoutCostsByPass) {
    Json json = Json::parse(toJson(hardRecord()));
    for (const char* later : {"by_pass", "other_screen"}) json["cost"].erase(later);
    json["cost"]["time"].erase("processor");
    const Record record = parseRecord(json.dump());
    EXPECT_TRUE(record.passes.empty());
    EXPECT_FALSE(record.otherScreen);
    EXPECT_EQ(toJson(record), json.dump());
}

/// A line of an older record, which had the least that a frame and its passes need: times of their own, and what they drew.
Json withBarePasses(Json json) {
    json["cost"]["time"]["bare"] = 15.2;
    json["cost"]["time"]["bare_ratio"] = 1.4;
    const Json least{{"source", "course, Shadow Mapping"}, {"milliseconds", 11.0}, {"fragments", 16384}};
    json["cost"]["by_pass"][1]["bare"] = json["cost"]["other_screen"]["by_pass"][1]["bare"] = least;
    return json;
}

TEST(OlderRecords, AreReadWithoutTheirBarePasses) {
    const Json json = Json::parse(toJson(hardRecord())), older = withBarePasses(json);
    EXPECT_EQ(toJson(parseRecord(older.dump())), json.dump());
    Json elsewhere = json;
    elsewhere["cost"]["bare"] = 15.2;
    EXPECT_THROW(parseRecord(elsewhere.dump()), BadInput);
}

/// Lines of older records as they are written today: the one tolerance that they state, their last member, has got company.
std::string renewed(std::string lines) {
    const std::string metric = R"("tolerance":{"metric":)", value = R"(,"value":)";
    for (std::size_t at = lines.find(metric); at != std::string::npos; at = lines.find(metric, at)) {
        lines.replace(at, metric.size(), R"("tolerances":{)");
        lines.replace(lines.find(value, at), value.size(), ":");
    }
    return lines;
}

void eraseBarePasses(Json& json) {
    if (!json.is_structured()) return;
    if (json.is_object())
        for (const char* retired : {"bare", "bare_ratio"}) json.erase(retired);
    for (Json& inner : json) eraseBarePasses(inner);
}

/// The line without what nothing reads any more.
std::string withoutBarePasses(const std::string& line) {
    if (!contains(line, "\"bare")) return line;
    Json json = Json::parse(line);
    eraseBarePasses(json);
    return json.dump();
}

TEST(PublishedRecords, ReadBackAsTheSameLine) {
    const std::filesystem::path results = std::filesystem::path(SOURCE_FOLDER) / "results";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(results)) {
        if (entry.path().extension() != ".jsonl" || entry.path().parent_path().filename() == "benchmarks") continue;
        std::string text, expected;
        for (const Record& record : readRecords(entry.path())) text += toJson(record) + "\n";
        std::istringstream lines(renewed(readFile(entry.path())));
        for (std::string line; std::getline(lines, line);) expected += withoutBarePasses(line) + "\n";
        EXPECT_EQ(text == expected, true) << entry.path();
        ++files;
    }
    EXPECT_GT(files, 10U);
}

} // namespace
} // namespace shadowbench
