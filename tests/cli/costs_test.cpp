// What techniques say of their own cost, by the instructions of a frame.
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace shadowbench {
namespace {

/// Instructions of a frame by technique, under a square light of `side` metres.
std::map<std::string, double> instructionsUnder(double side) {
    const Folder folder;
    const std::string light =
        fmt::format("{{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [{0}, 0, 0], v = [0, 0, {0}] }}", side);
    const Outcome outcome = shell(fmt::format(
        "shadowbench run --quiet --cost instructions --scene {} --technique occlusion-texture:map=128 --technique "
        "backprojection:map=128 --cache {} --out {}",
        folder.write("light.toml", tinyScene(light)), folder / "cache", folder / "out"));
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    std::map<std::string, double> instructions;
    for (const Record& record : readRecords(folder / "out/results.jsonl"))
        instructions[record.technique] = record.values["cost.instructions"].value();
    return instructions;
}

TEST(OcclusionTexture, ALargerLightCostsNoMore) {
    auto small = instructionsUnder(0.75), large = instructionsUnder(3);
    EXPECT_NEAR(large["occlusion-texture"] / small["occlusion-texture"], 1, 0.01); // more boxes are cut by the map's rim
    // What visits all texels before the light costs more: a measure that would tell.
    EXPECT_GT(large["backprojection"] / small["backprojection"], 1.2);
}

} // namespace
} // namespace shadowbench
