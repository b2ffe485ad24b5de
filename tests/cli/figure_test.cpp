// `figure` as a user calls it, on a scene of the user's own.
#include "base/files.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class FigureVerb : public testing::Test {
protected:
    static constexpr const char* cache = " --quiet --cache /tmp/shadowbench-test-references";

    [[nodiscard]] Outcome draw(const std::string& words, const std::string& out) const {
        return shell("shadowbench figure --out " + folder_ / out + " " + words);
    }

    Folder folder_;
    std::string scene_ = folder_.write("hall.toml", tinyScene());
};

TEST_F(FigureVerb, DrawsTheCellsOrTakesThoseOfARunAndShowsTheSame) {
    const std::string techniques = " --technique pcf:map=64 --technique volume-zfail";
    const Outcome drawn = draw("--scene " + scene_ + techniques + cache, "drawn.png");
    ASSERT_EQ(drawn.code, 0) << drawn.output;
    EXPECT_NE(drawn.output.find("figure: " + folder_ / "drawn.png"), std::string::npos) << drawn.output;
    EXPECT_NE(drawn.output.find("inset: "), std::string::npos) << "what to say for the same part again";

    const Outcome run =
        shell("shadowbench run --cost none --scene " + scene_ + techniques + cache + " --out " + folder_ / "run");
    ASSERT_EQ(run.code, 0) << run.output;
    for (const std::string records : {"run", "run/results.jsonl"}) {
        const Outcome taken = draw("--scene hall --records " + folder_ / records + techniques, "taken.png");
        ASSERT_EQ(taken.code, 0) << taken.output;
        EXPECT_EQ(readFile(folder_ / "taken.png"), readFile(folder_ / "drawn.png")) << records;
    }
    const Outcome shaded = draw(
        "--shaded --inset 4,4,10,10 --inset 20,20,10,10 --scene hall --records " + folder_ / "run" + techniques, "s.pdf");
    ASSERT_EQ(shaded.code, 0) << shaded.output;
    EXPECT_TRUE(readFile(folder_ / "s.pdf").starts_with("%PDF"));
    EXPECT_NE(readFile(folder_ / "s.tex").find("\\label{fig:s}"), std::string::npos);
}

TEST_F(FigureVerb, SaysWhatIsWrongBeforeItDrawsAnything) {
    for (const auto& [words, out, part] : {std::tuple("--technique pcf", "a.jpeg", "end with .pdf, .png or .svg"),
                                           {"--technique pcf --inset 1,2", "a.png", "is no inset"},
                                           {"--technique pfc", "a.png", "did you mean \"pcf\"?"},
                                           {"--technique pcss", "a.png", "needs an area light"}}) {
        const Outcome outcome = draw("--scene " + scene_ + " " + words + cache, out);
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        EXPECT_NE(outcome.output.find(part), std::string::npos) << outcome.output;
        EXPECT_FALSE(std::filesystem::exists(folder_ / out));
    }
    EXPECT_EQ(draw("--technique pcf", "a.png").code, 2) << "there is no scene to draw by default";
}

} // namespace
} // namespace shadowbench
