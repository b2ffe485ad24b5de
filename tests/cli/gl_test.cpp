// What draws: OSMesa or EGL, chosen by --gl; and what is said where there is neither.
#include "base/files.h"
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Nothing of a library opens that is to be found here.
const std::string noOsMesa = "SHADOWBENCH_LIBOSMESA=/nowhere/libOSMesa.so ",
                  noEgl = "SHADOWBENCH_LIBEGL=/nowhere/libEGL.so ";

class Gl : public testing::Test {
protected:
    void SetUp() override { scene_ = folder_.write("tiny.toml", tinyScene()); }

    /// Under EGL in software, whatever the machine has.
    [[nodiscard]] Outcome run(const std::string& variables, const std::string& options,
                              const std::string& out = "out") const {
        return shell("LIBGL_ALWAYS_SOFTWARE=1 " + variables + "shadowbench run --quiet --cost none --scene " + scene_ +
                     " --out " + folder_ / out + " --cache " + folder_.cache() + " " + options);
    }

    [[nodiscard]] std::vector<Record> records(const std::string& out = "out") const {
        return readRecords(folder_ / (out + "/results.jsonl"));
    }

    Folder folder_;
    std::string scene_;
};

void expectOneLine(const Outcome& outcome, int code, const std::string& text) {
    EXPECT_EQ(outcome.code, code) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_NE(outcome.output.find(text), std::string::npos) << outcome.output;
}

TEST_F(Gl, BothPlatformsDrawTheSameImagesAndSayWhichDrewThem) {
    const std::string rows = "--technique sm-uniform --technique pcf --technique volume-zfail --technique vsm --technique "
                             "sm-alias-free ";
    ASSERT_EQ(run("", rows + "--gl osmesa", "osmesa").code, 0);
    ASSERT_EQ(run("", rows + "--gl egl", "egl").code, 0);
    const std::vector<Record> osMesa = records("osmesa"), egl = records("egl");
    ASSERT_EQ(osMesa.size(), 5U);
    ASSERT_EQ(egl.size(), osMesa.size());
    for (std::size_t i = 0; i < egl.size(); ++i) {
        EXPECT_FALSE(egl[i].images.empty()) << egl[i].variant;
        EXPECT_EQ(egl[i].images, osMesa[i].images) << egl[i].variant;
        EXPECT_EQ(egl[i].environment.renderer, osMesa[i].environment.renderer);
        EXPECT_EQ(egl[i].environment.platform, "egl");
        EXPECT_EQ(osMesa[i].environment.platform, "osmesa");
        EXPECT_EQ(egl[i].environment.driver, osMesa[i].environment.driver);
        EXPECT_FALSE(egl[i].environment.vendor.empty());
    }
}

TEST_F(Gl, AutoIsOsMesaAndElseEgl) {
    ASSERT_EQ(run("SHADOWBENCH_GL=egl ", "--technique none --gl auto").code, 0) << "the option outranks the variable";
    EXPECT_EQ(records().front().environment.platform, "osmesa");
    ASSERT_EQ(run(noOsMesa, "--technique none", "without").code, 0);
    EXPECT_EQ(records("without").front().environment.platform, "egl");
}

TEST_F(Gl, AMissingLibraryIsOneLineAndInconclusive) {
    expectOneLine(run(noOsMesa + noEgl, "--technique none"), 5, "apt-get install libosmesa6");
    expectOneLine(run(noOsMesa, "--technique none --gl osmesa"), 5, "apt-get install libosmesa6, or draw through EGL");
    expectOneLine(run(noEgl, "--technique none --gl egl"), 5, "apt-get install libegl1");
    expectOneLine(shell(noOsMesa + noEgl + "shadowbench sweep --scene " + scene_ +
                        " --axis map --technique pcf --values 64 "
                        "--out " +
                        folder_ / "sweep"),
                  5, "there is no OpenGL to draw with");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/results.jsonl"));
}

TEST_F(Gl, AnUnknownPlatformIsBadInput) {
    expectOneLine(run("", "--technique none --gl glx"), 2, "glx");
    expectOneLine(run("SHADOWBENCH_GL=glx ", "--technique none"), 2, "there are auto, osmesa, egl");
}

TEST_F(Gl, AResumedRunDrawsAgainWhatAnotherPlatformDrew) {
    ASSERT_EQ(run("", "--technique none --gl osmesa").code, 0);
    ASSERT_EQ(run("", "--technique none --gl egl --resume").code, 0);
    ASSERT_EQ(records().size(), 1U);
    EXPECT_EQ(records().front().environment.platform, "egl");
}

} // namespace
} // namespace shadowbench
