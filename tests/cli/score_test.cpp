// `score` as a user calls it, and what every reader of records makes of its rows.
#include "base/image_io.h"
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class Score : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new Folder;
        scene_ = folder_->write("tiny.toml", tinyScene());
        const Outcome run =
            shell("shadowbench run --quiet --cost none --images --technique pcf --technique sm-uniform --scene " + scene_ +
                  " --out " + own() + " --cache " + folder_->cache());
        ASSERT_EQ(run.code, 0) << run.output;
    }
    static void TearDownTestSuite() { delete folder_; }

    static std::string own() { return *folder_ / "own"; }
    static std::string image(const std::string& variant, const std::string& file) {
        return own() + "/images/tiny/" + variant + "/" + file;
    }
    static Outcome score(const std::string& options, const std::string& out = "out") {
        return shell("shadowbench score --quiet --definition hard --scene " + scene_ + " --cache " + folder_->cache() +
                     " --out " + *folder_ / out + " " + options);
    }
    static std::vector<Record> records(const std::string& out = "out") {
        return readRecords(*folder_ / (out + "/results.jsonl"));
    }
    /// The one line with which an image is refused; nothing is written.
    static std::string refusal(const std::string& options) {
        const Outcome outcome = score(options, "refused");
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
        EXPECT_FALSE(fs::exists(*folder_ / "refused")) << options;
        return outcome.output;
    }
    static void expectIn(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
    }
    static nlohmann::json asJson(const Record& record) { return nlohmann::json::parse(toJson(record)); }

    static inline Folder* folder_ = nullptr;
    static inline std::string scene_;
};

TEST_F(Score, OurOwnImagesScoreWhatTheirCellsScored) {
    const std::vector<Record> cells = readRecords(own() + "/results.jsonl");
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Outcome outcome = score("--name own --image " + image(cells[i].variant, "frame-2.exr") + " " +
                                          image(cells[i].variant, "frame-3.exr"),
                                      cells[i].variant);
        ASSERT_EQ(outcome.code, 0) << outcome.output;
        const auto before = asJson(cells[i]), now = asJson(records(cells[i].variant).at(0));
        EXPECT_EQ(now["accuracy"], before["accuracy"]);
        EXPECT_EQ(now["stability"], before["stability"]);
        EXPECT_EQ(now["images"], before["images"]);
        EXPECT_EQ(now["reference"], before["reference"]);
        EXPECT_EQ(now["technique"], "external:own");
    }
}

TEST_F(Score, RowsOfOneFolderStayAndAreReadByEveryVerb) {
    const std::string visibility = image("pcf", "visibility.exr");
    ASSERT_EQ(score("--name a --image " + visibility).code, 0);
    ASSERT_EQ(score("--name b --renderer 'My engine 2' --image " + image("sm-uniform", "visibility.exr")).code, 0);
    ASSERT_EQ(score("--name a --image " + visibility).code, 0);
    ASSERT_EQ(records().size(), 2U);
    EXPECT_EQ(records()[1].technique, "external:b");
    EXPECT_EQ(records()[1].environment.renderer, "My engine 2");

    const std::string out = *folder_ / "out";
    EXPECT_EQ(shell("shadowbench report " + out + "/results.jsonl --out " + *folder_ / "page").code, 0);
    expectIn(shell("cat " + *folder_ / "page/report.md").output, "external:a");
    EXPECT_EQ(score("--name c --image " + visibility, "own").code, 0) << "into the folder of a run";
    EXPECT_EQ(records("own").size(), 3U);
    const Outcome same = shell("shadowbench compare " + out + " " + out + " --junit " + *folder_ / "shadows.xml");
    EXPECT_EQ(same.code, 0) << same.output;
    EXPECT_TRUE(fs::exists(*folder_ / "shadows.xml"));
}

TEST_F(Score, AWorseImageOfTheSameRowFailsTheComparison) {
    ASSERT_EQ(score("--name engine --image " + image("sm-uniform", "visibility.exr"), "before").code, 0);
    Image<float> worse = readChannel(image("sm-uniform", "visibility.exr"), 0);
    for (int y = 20; y < 28; ++y)
        for (int x = 4; x < 12; ++x) worse(x, y) = 0;
    writeExr(*folder_ / "worse.exr", {{"Y", &worse}});
    ASSERT_EQ(score("--name engine --image " + *folder_ / "worse.exr", "after").code, 0);
    const Outcome compared = shell("shadowbench compare " + *folder_ / "before" + " " + *folder_ / "after");
    EXPECT_EQ(compared.code, 4) << compared.output;
    expectIn(compared.output, "external:engine on tiny");
}

TEST_F(Score, WhatCannotBeScoredIsOneLine) {
    const std::string v = image("pcf", "visibility.exr");
    expectIn(refusal("--image " + image("pcf", "visibility.png")), "say --linear or --srgb");
    expectIn(refusal("--image " + *folder_ / "none.exr"), "is not there");
    expectIn(refusal("--image " + v + " --name Mine"), "is no name for a row");
    expectIn(refusal("--image " + v + " --frame 7"), "is scored on frame 2, or on all of 2, 3");
    expectIn(refusal("--image " + v + " --lit " + v + " " + v), "--lit names 2 files and --image 1");
    expectIn(refusal("--image " + v + " " + v + " " + v), "3 images and 2 frames");
    expectIn(refusal("--image " + v + " --linear --srgb"), "--srgb");
    const Image<float> half(24, 24, 1), black(48, 48, 0);
    writeExr(*folder_ / "half.exr", {{"Y", &half}});
    expectIn(refusal("--image " + *folder_ / "half.exr"), "half the width and height");
    writeExr(*folder_ / "black.exr", {{"Y", &black}});
    expectIn(refusal("--image " + *folder_ / "black.exr"), "is black");
    const Outcome all = score("--force --image " + *folder_ / "black.exr", "black");
    EXPECT_EQ(all.code, 0);
    expectIn(all.output, "warning: ");
    expectIn(records("black")[0].reason, "is black");
}

} // namespace
} // namespace shadowbench
