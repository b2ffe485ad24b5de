// What a renderer says of its own times is taken as documented or refused by the key that is wrong.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "harness/foreign/timing_file.h"

#include <gtest/gtest.h>

namespace shadowbench::foreign {
namespace {

class TimingFile : public testing::Test {
protected:
    std::optional<ReportedCost> costOf(const std::string& text) {
        writeFile(folder_.path() / "timing.json", text);
        return reportedCost(folder_.path() / "timing.json");
    }
    std::string refusalOf(const std::string& text) {
        try {
            costOf(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder_;
};

TEST_F(TimingFile, IsATimeOrTheMedianOfAList) {
    EXPECT_FALSE(reportedCost(folder_.path() / "none.json"));
    EXPECT_EQ(costOf(R"({"milliseconds": 1.25})")->milliseconds, 1.25);
    EXPECT_EQ(costOf(R"({"milliseconds": [4, 1, 2], "device": "a card"})")->milliseconds, 2);
    EXPECT_EQ(costOf(R"({"milliseconds": [4, 1], "device": "a card"})")->milliseconds, 2.5);
    EXPECT_EQ(costOf(R"({"milliseconds": 1, "device": "a card"})")->device, "a card");
}

TEST_F(TimingFile, IsRefusedByWhatIsWrong) {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"", "is no JSON object"},
        {"[1]", "is no JSON object"},
        {R"({"milliseconds": 1, "devise": "a"})", "unknown key \"devise\" (did you mean \"device\"?)"},
        {R"({"device": "a"})", "lacks \"milliseconds\""},
        {R"({"milliseconds": "1"})", "no number: \"1\""},
        {R"({"milliseconds": 0})", "not above 0"},
        {R"({"milliseconds": -1})", "not above 0"},
        {R"({"milliseconds": []})", "milliseconds is []"},
        {R"({"milliseconds": [1, [2]]})", "no number: [2]"},
        {R"({"milliseconds": 1, "device": 7})", "a device that is no text: 7"},
        {R"({"milliseconds": )" + std::string(100'000, '['), "nested deeper"}};
    for (const auto& [text, words] : wrong) EXPECT_NE(refusalOf(text).find(words), std::string::npos) << refusalOf(text);
}

} // namespace
} // namespace shadowbench::foreign
