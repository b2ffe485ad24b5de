// `inspect` as a user types it, and what `run` says of the same scenes.
#include "base/image_io.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

class InspectVerb : public testing::Test {
protected:
    [[nodiscard]] Outcome inspected(const std::string& words) const {
        return shell("shadowbench inspect " + words + " --out " + folder_ / "out");
    }
    [[nodiscard]] Outcome ran(const std::string& scene) const {
        return shell("shadowbench run --quiet --cost none --technique none --scene " + scene + " --out " + folder_ / "run" +
                     " --cache " + folder_.cache());
    }

    Folder folder_;
    std::string sound_ = folder_.write("tiny.toml", tinyScene());
    std::string dark_ = folder_.write("dark.toml", tinyScene("{ kind = \"point\", centre = [0.2, -4, 0.2] }"));
};

TEST_F(InspectVerb, ShowsASceneAndAPicture) {
    const Outcome outcome = inspected(sound_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.starts_with("tiny (gate): Tiny\n  picture   " + folder_ / "out/tiny.png" + "\n  size "))
        << outcome.output;
    for (const char* label : {"\n  camera ", "\n  up ", "\n  light ", "\n  object ", "\n  frame ", "\n  map "})
        EXPECT_NE(outcome.output.find(label), std::string::npos) << label;
    EXPECT_EQ(outcome.output.find("warning"), std::string::npos) << outcome.output;
    EXPECT_EQ(readChannel(folder_ / "out/tiny.png", 0).width(), 48);
}

TEST_F(InspectVerb, WarnsWithARemedyAndExitsWithZero) {
    const Outcome outcome = inspected(dark_ + " simple");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.output.find("\n  warning: 100 % of what is seen faces away from the light, which is 3.8 m below the "
                                  "whole scene; move it above\n"),
              std::string::npos)
        << outcome.output;
    EXPECT_NE(outcome.output.find("\n\nsimple (gate): "), std::string::npos);
}

TEST_F(InspectVerb, PrintsJson) {
    const Outcome outcome = inspected(dark_ + " " + sound_ + " --json");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto json = nlohmann::json::parse(outcome.output);
    ASSERT_EQ(json.size(), 2U);
    EXPECT_EQ(json[0]["warnings"].size(), 1U);
    EXPECT_EQ(json[1]["scene"], "tiny");
    EXPECT_TRUE(std::filesystem::exists(json[1]["picture"].get<std::string>()));
}

TEST_F(InspectVerb, WhatCannotBeUsedIsBadInput) {
    EXPECT_EQ(inspected("").code, 2);
    EXPECT_EQ(inspected("dueling-frustra").code, 2);
    const Outcome inside =
        inspected(folder_.write("inside.toml", tinyScene("{ kind = \"point\", centre = [3.1, 0, 2.2] }")));
    EXPECT_EQ(inside.code, 2);
    EXPECT_NE(inside.output.find("the light lies on a surface"), std::string::npos) << inside.output;
}

TEST_F(InspectVerb, ARunSaysTheSameBeforeItMeasures) {
    const Outcome dark = ran(dark_);
    EXPECT_EQ(dark.code, 0) << dark.output;
    EXPECT_TRUE(dark.output.starts_with("dark: warning: 100 % of what is seen faces away from the light")) << dark.output;
    EXPECT_EQ(ran(sound_).output.find("warning"), std::string::npos);
}

TEST_F(InspectVerb, WhatARunCannotScoreForItsSceneIsSentHere) {
    // Ten thousand kilometres from its own origin, and turned back to the world's.
    folder_.write("far.obj", "v 9999996 0 -4\nv 10000004 0 -4\nv 10000004 0 4\nv 9999996 0 4\nf 1 4 3\nf 1 3 2\n");
    const Outcome far = ran(folder_.write(
        "far.toml", "title = \"Far\"\nsize = 32\nlight = { kind = \"directional\", direction = [0.3, -1, 0.2] }\n"
                    "camera = { eye = [2, 6, 7], target = [0, 0, 0], near = 0.5, far = 40, fovy = 45 }\n"
                    "timeline = { still = 1, moving = 0 }\n[[object]]\nmesh = { file = \"far.obj\" }\n"
                    "place = [{ at = [-8660254.038, 0, 5000000], turn = 30 }]\n"));
    EXPECT_EQ(far.code, 1) << far.output;
    EXPECT_NE(far.output.find("disagree on the primary hit"), std::string::npos) << far.output;
    EXPECT_NE(far.output.find("(shadowbench inspect SCENE says why), or details are"), std::string::npos) << far.output;
    EXPECT_NE(far.output.find("are up to 1e+07 m from its own origin"), std::string::npos) << far.output;
}

} // namespace
} // namespace shadowbench
