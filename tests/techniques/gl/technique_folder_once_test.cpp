// Passes of technique folders that are drawn once, until light or casters change.
#include "harness/measure/pass_cost.h"
#include "tests/support/message_of.h"
#include "tests/support/technique_folders.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

const std::string onceToml = replaced(mapToml, "offset = [2, 64]", "offset = [2, 64]\nonce = \"light\"");

/// Of one frame.
std::vector<std::string> passesOf(Stage& stage, techniques::Technique& technique) {
    std::vector<std::string> names;
    for (const timing::PassCost& pass :
         timing::countPasses([&](techniques::PassListener& listener) { stage.render(technique, 0, 1, &listener); }).passes)
        names.push_back(pass.name);
    return names;
}

bool draws(const std::vector<std::string>& passes, const char* name) { return std::ranges::count(passes, name) > 0; }

TEST(FolderOnce, TheMapIsNoPassOfAFrameInWhichNothingHasChanged) {
    const Scene scene = boxScene(32);
    Stage stage(scene);
    stage.show(0);
    const WrittenTechnique folder(onceToml);
    const auto technique = folder.made();
    EXPECT_TRUE(draws(passesOf(stage, *technique), "depth map"));
    const std::vector<std::string> later = passesOf(stage, *technique);
    EXPECT_FALSE(draws(later, "depth map"));
    EXPECT_TRUE(draws(later, "resolve"));
    technique->reset();
    EXPECT_TRUE(draws(passesOf(stage, *technique), "depth map"));
    EXPECT_TRUE(draws(passesOf(stage, *WrittenTechnique().made()), "depth map"));
    EXPECT_EQ(folder.entry().computed, "when light or casters change, depth map; each frame, the other passes");
    EXPECT_EQ(WrittenTechnique().entry().computed, "");
}

TEST(FolderOnce, WhatIsKeptDoesNotShowWhateverMoves) {
    Scene scene = boxScene(64);
    Stage stage(scene);
    const auto kept = WrittenTechnique(onceToml).made();
    const auto anew = [&] {
        const auto fresh = WrittenTechnique().made();
        stage.render(*fresh, 0, 1);
        return stage.visibility();
    };
    Snapshot shown = snapshot(scene, 0);
    Image<float> before(64, 64);
    const auto expectAnswer = [&](const char* what, bool isOther = true) {
        stage.show(shown);
        stage.render(*kept, 0, 1);
        const Image<float> mine = stage.visibility();
        EXPECT_TRUE(std::ranges::equal(mine, anew())) << what;
        EXPECT_EQ(!std::ranges::equal(mine, before), isOther) << what;
        before = mine;
    };
    expectAnswer("the first frame");
    expectAnswer("the same", false);
    shown.camera.eye.x += 0.5;
    expectAnswer("the camera moves");
    shown.light.centre.x += 0.5;
    expectAnswer("the light moves");
    shown.batches.back().placements.front().world[3].x += 0.3;
    expectAnswer("a caster moves");
    shown.batches.pop_back();
    expectAnswer("a caster goes");
}

TEST(FolderOnce, WhatChangesFromFrameToFrameIsRefused) {
    testContext();
    const auto errorOf = [](const std::string& toml, const std::string& map = "") {
        const WrittenTechnique folder(toml);
        folder.write("map.frag", map);
        const std::string error = test::messageOf<BadInput>([&] { folder.made(); });
        return error.starts_with(folder.path().string()) ? error.substr(folder.path().string().size()) : error;
    };
    EXPECT_EQ(errorOf(replaced(onceToml, "answer", "view = \"focused\"\nanswer")),
              "/technique.toml:21: pass[1].once: is of the view scene: the others change from frame to frame");
    EXPECT_EQ(errorOf(replaced(onceToml, "once = \"light\"", "once = \"frame\"")),
              "/technique.toml:20: pass[1].once: expected one of light, got \"frame\"");
    EXPECT_EQ(errorOf(onceToml + "once = \"light\"\n"),
              "/technique.toml:27: pass[2].once: visibility is each frame's own; keep a target that it is made of");
    const std::string blur =
        "[target.blurred]\nformat = \"R32F\"\nsize = \"map\"\n\n[[pass]]\nname = \"blur\"\ndraw = "
        "\"screen\"\nfragment = \"map.frag\"\nto = \"blurred\"\nonce = \"light\"\n\n[[pass]]\nname = \"resolve\"";
    const std::string blurred = replaced(mapToml, "[[pass]]\nname = \"resolve\"", blur);
    const std::string ofMap =
        "uniform sampler2DShadow depths;\nout float v;\nvoid main() { v = texture(depths, vec3(0.5)); }\n";
    EXPECT_EQ(errorOf(blurred, ofMap),
              "/map.frag:1: the pass \"blur\" is drawn once, but depths in each frame: say once of both or of none");
    EXPECT_EQ(errorOf(replaced(blurred, "offset = [2, 64]", "once = \"light\""), ofMap), "");
    EXPECT_EQ(
        errorOf(blurred, "uniform vec3 eye;\nout float v;\nvoid main() { v = eye.x; }\n"),
        "/map.frag:1: \"eye\" changes from frame to frame, and the pass \"blur\" is drawn once: leave one of the two out");
    EXPECT_EQ(
        errorOf(replaced(blurred, "to = \"visibility\"",
                         "to = \"blurred\"\n\n[[pass]]\nname = \"last\"\ndraw = \"screen\"\nfragment = "
                         "\"resolve.frag\"\nto = \"visibility\""),
                ofMap),
        "/technique.toml:36: pass[3].to: blurred is written by \"blur\" as well, one of them once and the other in each "
        "frame: say once of both or of none");
    EXPECT_NE(errorOf(replaced(blurred, "size = \"map\"\n\n[[pass]]\nname = \"blur\"",
                               "size = \"image\"\n\n[[pass]]\nname = \"blur\""),
                      ofMap)
                  .find("blurred is as large as the image, whose camera moves: keep a map"),
              std::string::npos);
}

} // namespace
} // namespace shadowbench
