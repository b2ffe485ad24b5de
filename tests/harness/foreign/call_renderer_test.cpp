// Each way in which a renderer fails ends with a sentence of its own.
#include "harness/foreign/call_renderer.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "base/temporary_folder.h"

#include <gtest/gtest.h>

namespace shadowbench::foreign {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class CallingARenderer : public ::testing::Test {
protected:
    CallingARenderer() { fs::create_directories(out()); }

    [[nodiscard]] Renderer renderer(const std::string& script) const {
        Renderer renderer;
        renderer.id = "fake";
        renderer.command = {"sh", "-c", script, "{scene}", "{frames}", "{out}"}; // $0, $1 and $2 of the script
        renderer.folder = folder_.path();
        renderer.limit = 20s;
        return renderer;
    }
    Rendered call(const Renderer& renderer) const {
        return callRenderer(renderer, "/the/scene", {59, 60}, out(), ownEnvironment());
    }
    [[nodiscard]] std::string failure(const Renderer& renderer) const {
        try {
            call(renderer);
        } catch (const Inconclusive& error) {
            return error.what();
        }
        return "";
    }
    [[nodiscard]] std::string failure(const std::string& script) const { return failure(renderer(script)); }
    [[nodiscard]] fs::path out() const { return folder_.path() / "out"; }

    TemporaryFolder folder_;
};

const std::string writesBoth = "for i in 59 60; do : > $2/frame-$i.exr; done;";

TEST_F(CallingARenderer, GivesItTheSceneTheFramesAndAFolder) {
    const Rendered rendered = call(renderer(writesBoth + "echo \"$0 $1 $2\" > said; : > $2/frame-60-depth.pfm"));
    EXPECT_EQ(readFile(folder_.path() / "said"), "/the/scene 59,60 " + out().string() + "\n");
    ASSERT_EQ(rendered.frames.size(), 2U);
    EXPECT_EQ(rendered.frames[0].frame, 59);
    EXPECT_EQ(rendered.frames[0].image, out() / "frame-59.exr");
    EXPECT_FALSE(rendered.frames[0].depth);
    EXPECT_EQ(rendered.frames[1].depth, out() / "frame-60-depth.pfm");
    EXPECT_FALSE(rendered.reported);
}

TEST_F(CallingARenderer, RunsALineOfTheShellWithQuotedFolders) {
    Renderer line = renderer("");
    line.command = {"/bin/sh", "-c", "for i in 59 60; do cp {scene} {out}/frame-$i.png; done"};
    line.isShellLine = true;
    const fs::path scene = folder_.path() / "it's $HOME";
    writeFile(scene, "x");
    EXPECT_EQ(callRenderer(line, scene, {59, 60}, out(), ownEnvironment()).frames[1].image, out() / "frame-60.png");
}

TEST_F(CallingARenderer, LetsItSeeOurVariablesAndItsOwn) {
    Renderer asks = renderer(writesBoth + "echo \"$HOME $SKY $OURS\" > said");
    asks.environment = {{"SKY", "blue"}, {"OURS", "replaced"}};
    callRenderer(asks, "/the/scene", {59, 60}, out(), {"HOME=/home/user", "OURS=1", "PATH=/usr/bin:/bin"});
    EXPECT_EQ(readFile(folder_.path() / "said"), "/home/user blue replaced\n");
}

TEST_F(CallingARenderer, SaysHowItDied) {
    EXPECT_EQ(failure("echo loading; echo no GPU >&2; exit 7"), "its command ended with exit code 7; it last said: no GPU");
    EXPECT_EQ(failure("kill -SEGV $$"), "its command was ended by signal 11 (Segmentation fault)");
    Renderer hangs = renderer("echo waiting; sleep 300 & sleep 300");
    hangs.limit = 300ms;
    EXPECT_EQ(failure(hangs),
              "its command did not end within its time_limit of 0.3 s and was killed; it last said: waiting");
}

TEST_F(CallingARenderer, StopsOneThatFloodsItsOutputInOneLine) {
    const std::string said = failure("yes \"$(printf 'a\\033[0m%0300d' 1)\"");
    EXPECT_TRUE(
        said.starts_with("its command wrote more than 16 MiB to its standard output and was killed; it last said: a [0m"))
        << said;
    EXPECT_LT(said.size(), 350U);
}

TEST_F(CallingARenderer, NamesWhatIsMissing) {
    EXPECT_EQ(failure("exit 0"), "its command wrote no image of frames 59, 60 (frame-59.exr, .png or .pfm in {out}): the "
                                 "folder is empty");
    EXPECT_TRUE(failure("rm -r $2").ends_with("the folder is gone"));
    fs::create_directories(out());
    EXPECT_EQ(
        failure(": > $2/frame-59.exr; : > $2/frame-060.exr"),
        "its command wrote no image of frame 60 (frame-60.exr, .png or .pfm in {out}): the folder holds frame-060.exr, "
        "frame-59.exr");
    EXPECT_EQ(failure(writesBoth + ": > $2/frame-59.png"),
              "its command wrote both frame-59.exr and frame-59.png: which one is meant?");
}

TEST_F(CallingARenderer, SaysThatItsProgramIsNotThere) {
    Renderer gone = renderer("");
    gone.command.front() = "./no-such-program";
    EXPECT_EQ(failure(gone), "its program ./no-such-program is not there, or may not be run; install it, or correct "
                             "`command` of fake");
}

TEST_F(CallingARenderer, ReadsTheCostThatItReports) {
    const auto reported = [&](const std::string& json) {
        return call(renderer(writesBoth + "echo '" + json + "' > $2/timing.json")).reported;
    };
    EXPECT_EQ(reported(R"({"milliseconds": 1.25, "device": "a GPU"})")->milliseconds, 1.25);
    EXPECT_EQ(reported(R"({"milliseconds": 1.25, "device": "a GPU"})")->device, "a GPU");
    EXPECT_EQ(reported(R"({"milliseconds": [3, 1, 2, 10]})")->milliseconds, 2.5);
    for (const char* wrong :
         {"{", "[]", "{}", R"({"milliseconds": 0})", R"({"milliseconds": "1"})", R"({"milliseconds": []})",
          R"({"milliseconds": 1, "devise": "x"})", R"({"milliseconds": 1, "device": 3})"})
        EXPECT_TRUE(failure(writesBoth + "echo '" + wrong + "' > $2/timing.json").starts_with("its timing.json ")) << wrong;
}

} // namespace
} // namespace shadowbench::foreign
