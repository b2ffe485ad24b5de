// `shadowbench causes` as a user runs it.
#include "tests/support/program.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench {
namespace {

class Causes : public testing::Test {
protected:
    [[nodiscard]] Outcome causes(const std::string& options) const {
        return shell("shadowbench causes --quiet --out " + folder_ / "out" + " --cache " + folder_.cache() + " " + options);
    }

    Folder folder_;
    std::string scene_ = folder_.write(
        "tiny.toml", tinyScene("{ kind = \"point\", centre = [1.7, 6.1, -2.3] }", "[tolerance]\nmismatch = 0.01\n"));
};

TEST_F(Causes, PrintsWhatToChangeFirstAndDrawsThePicture) {
    const Outcome outcome = causes("--technique sm-uniform:map=16 --technique volume-zfail --scene " + scene_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("undersampled"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("map=32"), std::string::npos) << outcome.output;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/tiny/sm-uniform_map=16.png"));
    std::ifstream file(folder_ / "out/causes.json");
    const auto rows = nlohmann::json::parse(file).at(0).at("rows");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("metric"), "mismatch");
    double sum = 0;
    for (const auto& [cause, error] : rows[0].at("causes").items()) sum += error.get<double>();
    EXPECT_NEAR(sum, rows[0].at("error").get<double>(), 1e-6);
    EXPECT_FALSE(rows[1].at("causes").contains("undersampled")) << "a volume has no texels";
}

TEST_F(Causes, TheTableFitsATerminalAndNamesEachReasonOnce) {
    const Outcome outcome = causes(
        "--technique sm-uniform:map=16 --technique pcf:map=32,bias=none --technique 'p*' --technique bitmask --scene " +
        scene_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    std::istringstream lines(outcome.output);
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), line.starts_with("page: ") ? 999U : 120U) << line;
    const std::string reason = "needs an area light";
    const std::size_t first = outcome.output.find(reason);
    ASSERT_NE(first, std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find(reason, first + 1), std::string::npos) << outcome.output;
    for (const char* row : {" bitmask,", " pcss,", " pcss:taps=32+32,", " penumbra-wedge:side=3,"})
        EXPECT_NE(outcome.output.find(row, first), std::string::npos) << row << outcome.output;
}

TEST_F(Causes, WrongArgumentsEndInOneLine) {
    for (const std::string options :
         {"--technique lod-full", "--technique sm-unifrom", "--technique pcss", "--caster-level 1"}) {
        const Outcome outcome = causes(options + " --scene " + scene_);
        EXPECT_EQ(outcome.code, 2) << options << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    }
}

} // namespace
} // namespace shadowbench
