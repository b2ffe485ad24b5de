// `shadowbench recommend` as a user runs it.
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

/// The tiny scene with a ball of four levels in the air.
std::string ballScene(const std::string& light = "{ kind = \"point\", centre = [1.7, 6.1, -2.3] }") {
    return tinyScene(light, "[[object]]\nname = \"balls\"\nmesh = { sphere = { radius = 0.7 } }\n"
                            "lod = { triangles = [720, 180, 80, 20], until = [3, 9, 12] }\n"
                            "place = [{ at = [-1.4, 1.1, -0.6] }, { at = [1.6, 1.3, 2.1] }]\n"
                            "[tolerance]\nmismatch = 0.01\nrmse = 0.02\n");
}

class Recommend : public testing::Test {
protected:
    [[nodiscard]] Outcome recommend(const std::string& options) const {
        return shell("shadowbench recommend --quiet --out " + folder_ / "out" + " --cache " + folder_.cache() + " " +
                     options);
    }

    Folder folder_;
    std::string scene_ = folder_.write("balls.toml", ballScene());
    std::string soft_ = folder_.write(
        "soft.toml",
        ballScene("{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [0.9, 0, 0.1], v = [0.1, 0, -0.9] }"));
};

TEST_F(Recommend, PrintsTheLevelOfEachBandAndTheTrianglesSaved) {
    const Outcome outcome = recommend("--scene " + scene_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("% saved"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("verified by polygon"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("720 180 80 20 4 0"), std::string::npos) << outcome.output;
}

TEST_F(Recommend, PrintsTheSameAsJson) {
    const Outcome outcome = recommend("--json --bands 9 --scene " + scene_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto casters = nlohmann::json::parse(outcome.output).at(0).at("casters");
    EXPECT_TRUE(casters.at("verified"));
    EXPECT_EQ(casters.at("tolerance").at("mismatch"), 0.01);
    EXPECT_LE(casters.at("errors").at("mismatch"), 0.01);
    int triangles = 0;
    for (const auto& group : casters.at("groups")) {
        const std::size_t level = group.at("level");
        triangles += group.at("instances").get<int>() * group.at("levels").at(level).get<int>();
        if (group.contains("coarser")) {
            EXPECT_GT(group.at("coarser").at("verified_errors").at("mismatch"), 0.01);
        }
    }
    EXPECT_EQ(casters.at("all_triangles"), triangles);
    EXPECT_LT(triangles, 2 * 720);
}

TEST_F(Recommend, SaysWhenTheChainHasNoCoarserLevel) {
    const Outcome outcome = recommend("--tolerance 0.5 --levels 720,180 --scene " + scene_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("none in the chain"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("give more with --levels"), std::string::npos) << outcome.output;
}

// By the exact fraction the levels err by 0.017, within 0.02; by 4 points, that see a penumbra in steps of a quarter, by
// 0.031.
TEST_F(Recommend, OfAnAreaLightIsInconclusiveWhenTooFewPointsVerifyIt) {
    EXPECT_EQ(recommend("--scene " + soft_).code, 0);
    const Outcome few = recommend("--light-samples 4 --scene " + soft_);
    EXPECT_EQ(few.code, 5) << few.output;
    EXPECT_NE(few.output.find("NOT VERIFIED"), std::string::npos) << few.output;
}

TEST_F(Recommend, RunsTheCellsThatMapsAreReadOffAndKeepsTheirRecords) {
    const std::string maps =
        "--what map,technique --technique sm-uniform --technique none --tolerance 0.02 --scene " + scene_;
    const Outcome outcome = recommend(maps);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("smallest map"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("cheapest technique within mismatch 2 %, leak 5 %, "), std::string::npos)
        << outcome.output;
    const bool isAdvised = outcome.output.find(" missing_edges 5 %: sm-uniform, at ") != std::string::npos;
    const bool isUnsteady = outcome.output.find("timed too unsteadily to rank: sm-uniform") != std::string::npos;
    EXPECT_TRUE(isAdvised || isUnsteady) << "on a busy machine no time ranks anything: " << outcome.output;
    EXPECT_NE(outcome.output.find("   the error of sm-uniform, in %: "), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("; change first: "), std::string::npos) << outcome.output;
    EXPECT_EQ(readRecords(folder_ / "out/map/results.jsonl").size(), 5U); // 256 to 4096

    const Outcome read = recommend(maps + " --records " + folder_ / "out/map/results.jsonl");
    EXPECT_NE(read.code, 0); // --out and --records exclude each other
    const Outcome fromRecords = shell("shadowbench recommend --what map --json --scene " + scene_ + " --records " +
                                      folder_ / "out/map/results.jsonl");
    ASSERT_EQ(fromRecords.code, 0) << fromRecords.output;
    EXPECT_FALSE(nlohmann::json::parse(fromRecords.output).at(0).at("map").empty());
}

TEST_F(Recommend, WrongArgumentsEndInOneLine) {
    for (const std::string options :
         {"--scene dueling-frusta --what casters", "--scene windmills --levels 600,300", "--scene windmils",
          "--scene windmills --what levels", "--scene windmills --tolerance rmse=0.1",
          "--scene windmills --levels rotors=many", "--scene windmills --bands 9,7"}) {
        const Outcome outcome = recommend(options);
        EXPECT_EQ(outcome.code, 2) << options << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    }
}

} // namespace
} // namespace shadowbench
