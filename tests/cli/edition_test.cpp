// tools/edition of tiny scenes, and the program that an edition is checked with.
#include "base/files.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class Edition : public testing::Test {
protected:
    [[nodiscard]] Outcome made(const std::string& out, const std::string& scenes) const {
        return shell("SHADOWBENCH_CACHE=" + folder_ / "cache" +
                     " SHADOWBENCH_PROGRAM=" PROGRAM " " SOURCE_FOLDER "/tools/edition 2026 " + scenes + " --out " +
                     folder_ / out);
    }
    [[nodiscard]] Outcome verify(const std::string& words = "") const {
        return shell("python3 " + folder_ / "edition/verify.py" + " " + words);
    }
    static bool canVerify() { return shell("python3 -c 'import numpy, OpenImageIO'").code == 0; }

    Folder folder_;
    std::string tiny_ = "--scene " + folder_.write("tiny.toml", tinyScene());
    std::string soft_ =
        "--scene " +
        folder_.write("soft.toml",
                      tinyScene("{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [1, 0, 0], v = [0, 0, 1] }"));
};

TEST_F(Edition, HoldsEveryTruthOfEveryFrameAndIsTheSameEveryTime) {
    const Outcome first = made("edition", tiny_ + " " + soft_);
    ASSERT_EQ(first.code, 0) << first.output;
    const std::string truths = folder_ / "edition/scenes/";
    for (const char* file : {"tiny/truth/frame-2-hard", "tiny/truth/frame-3-hard", "tiny/truth/frame-3-pixel-area",
                             "soft/truth/frame-2-soft", "soft/truth/frame-2-area", "soft/truth/frame-2-irradiance",
                             "soft/truth/frame-2-solid-angle", "soft/truth/frame-3-soft"}) {
        EXPECT_TRUE(fs::exists(truths + file + ".exr")) << file;
        EXPECT_FALSE(nlohmann::json::parse(readFile(truths + file + ".json"))["key"].empty()) << file;
    }
    EXPECT_FALSE(fs::exists(truths + "soft/truth/frame-3-irradiance.exr"));
    EXPECT_NE(readFile(folder_ / "edition/CITATION.cff").find("version: \"2026\""), std::string::npos);

    fs::remove_all(folder_ / "cache"); // computed anew
    ASSERT_EQ(made("again", tiny_ + " " + soft_).code, 0);
    EXPECT_EQ(readFile(folder_ / "again/SHA256SUMS"), readFile(folder_ / "edition/SHA256SUMS"));
}

TEST_F(Edition, AStoppedOneGoesOnWithWhatItHad) {
    ASSERT_EQ(made("edition", tiny_ + " --scene no-such-scene").code, 2);
    EXPECT_FALSE(fs::exists(folder_ / "edition"));
    const auto finished = fs::last_write_time(folder_ / "edition.unfinished/scenes/tiny");
    ASSERT_EQ(made("edition", tiny_).code, 0);
    EXPECT_EQ(fs::last_write_time(folder_ / "edition/scenes/tiny"), finished);
    const Outcome there = made("edition", tiny_);
    EXPECT_EQ(there.code, 2);
    EXPECT_NE(there.output.find("is there already: remove it"), std::string::npos) << there.output;
}

TEST_F(Edition, ItsOwnProgramChecksItAndScoresAsOursDoes) {
    if (!canVerify()) GTEST_SKIP() << "numpy or OpenImageIO is missing: apt-get install $(./bench packages edition)";
    ASSERT_EQ(made("edition", tiny_).code, 0);
    const Outcome whole = verify();
    EXPECT_EQ(whole.code, 0) << whole.output;

    const std::string scene = tiny_.substr(tiny_.find('/'));
    ASSERT_EQ(shell("shadowbench run --quiet --cost none --images --technique sm-uniform:map=64 --scene " + scene +
                    " --out " + folder_ / "run" + " --cache " + folder_ / "cache")
                  .code,
              0);
    nlohmann::json accuracy = nlohmann::json::parse(readFile(folder_ / "run/results.jsonl"))["accuracy"];
    const Outcome scored = verify("score tiny '" + folder_ / "run/images/tiny/sm-uniform_map=64/visibility.exr" + "'");
    ASSERT_EQ(scored.code, 0) << scored.output;
    std::istringstream lines(scored.output);
    std::string image, frame, truth, metric, value;
    int compared = 0;
    while (lines >> image >> frame >> truth >> metric >> value) {
        const nlohmann::json& of = truth == "hard" ? accuracy : accuracy["pixel_area"];
        if (!of.contains(metric)) continue;
        EXPECT_EQ(std::stod(value), of[metric].get<double>()) << truth << " " << metric;
        ++compared;
    }
    EXPECT_GE(compared, 6) << scored.output;

    std::ofstream(folder_ / "edition/scenes/tiny/scene.obj", std::ios::app) << "# changed\n";
    const Outcome changed = verify();
    EXPECT_EQ(changed.code, 1);
    EXPECT_NE(changed.output.find("scenes/tiny/scene.obj: changed"), std::string::npos) << changed.output;
}

} // namespace
} // namespace shadowbench
