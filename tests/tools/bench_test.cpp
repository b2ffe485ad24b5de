// ./bench in a copy of its own, with stand-ins for apt-get, dpkg-query and cmake that only write down that they were called.
#include "base/files.h"
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class Bench : public testing::Test {
protected:
    Bench() {
        const fs::path source = SOURCE_FOLDER;
        for (const char* file : {"bench", "packages.txt"}) fs::copy_file(source / file, tree_ / file);
        fs::create_directory(tree_ / "bin");
        standIn("id", "echo 0"); // root
        standIn("dpkg-query", "case \"$*\" in *povray*) exit 1 ;; *) echo installed ;; esac");
        standIn("apt-get",
                note + "case \"$*\" in *--assume-no*) printf 'Reading lists...\\nNeed to get 12.3 MB of archives.\\n"
                       "After this operation, 45.6 MB of additional disk space will be used.\\nAbort.\\n'; exit 1 ;; "
                       "esac");
        standIn("cmake",
                note + "for i in $(seq 30); do echo \"[$i/30] Building CXX object a.o\"; echo 'note: a warning'; done");
        standIn("ctest", note);
    }

    void standIn(const std::string& name, const std::string& script) const {
        const fs::path file = tree_.write("bin/" + name, "#!/bin/sh\n" + script + "\n");
        fs::permissions(file, fs::perms::owner_all);
    }

    [[nodiscard]] Outcome bench(const std::string& arguments) const {
        return shell("PATH=" + tree_ / "bin:$PATH" + " TREE=" + tree_ / "" + " " + tree_ / "bench" + " " + arguments);
    }

    /// Every call of apt-get, cmake and ctest, a line each.
    [[nodiscard]] std::string calls() const {
        return fs::exists(tree_ / "calls") ? readFile(tree_ / "calls") : std::string();
    }

    const std::string note = "echo \"${0##*/} $*\" >>$TREE/calls; ";
    Folder tree_;
};

TEST_F(Bench, HelpNeitherInstallsNorBuilds) {
    for (const char* arguments : {"", "help", "--help", "-h"}) {
        const Outcome outcome = bench(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.output;
        EXPECT_NE(outcome.output.find("./bench run [OPTIONS]"), std::string::npos) << outcome.output;
        EXPECT_EQ(outcome.output.find('#'), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(calls(), "");
    EXPECT_FALSE(fs::exists(tree_ / "build"));
}

TEST_F(Bench, SaysWhatItInstallsAndHowLargeThatIs) {
    const Outcome outcome = bench("list");
    const std::size_t what = outcome.output.find("these packages are missing: povray");
    const std::size_t size = outcome.output.find("Need to get 12.3 MB of archives.\nAfter this operation, 45.6 MB");
    const std::size_t start = outcome.output.find("installing them");
    ASSERT_NE(start, std::string::npos) << outcome.output;
    EXPECT_LT(what, size);
    EXPECT_LT(size, start);
    EXPECT_NE(calls().find("apt-get install -y -qq --no-install-recommends povray"), std::string::npos) << calls();
}

TEST_F(Bench, AFailedInstallationShowsWhatAptSaid) {
    standIn("apt-get", "case \"$*\" in *-y*) echo 'E: no space left'; exit 100 ;; esac");
    const Outcome outcome = bench("list");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_NE(outcome.output.find("E: no space left\nbench: apt-get install failed"), std::string::npos) << outcome.output;
}

TEST_F(Bench, TestPackagesAreInstalledForTestsOnly) {
    standIn("dpkg-query", "exit 1");
    (void)bench("list");
    EXPECT_NE(calls().find("povray"), std::string::npos);
    EXPECT_EQ(calls().find("clang-format"), std::string::npos);
    (void)bench("test");
    EXPECT_NE(calls().find("clang-format"), std::string::npos);
    EXPECT_EQ(calls().find("clang-tidy"), std::string::npos);
    EXPECT_NE(bench("packages lint").output.find("clang-tidy\n"), std::string::npos);
    EXPECT_EQ(bench("packages paint").code, 2);
}

TEST_F(Bench, ABuildThatWorksIsQuiet) {
    const Outcome outcome = bench("test -L fast");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(outcome.output.find("warning"), std::string::npos) << outcome.output;
    EXPECT_LE(std::ranges::count(outcome.output, '\n'), 8) << outcome.output;
    EXPECT_NE(calls().find("ctest --output-on-failure -j"), std::string::npos) << calls();
    EXPECT_NE(calls().find("-L fast\n"), std::string::npos) << calls();
}

TEST_F(Bench, ABuildThatFailsShowsWhatTheCompilerSaid) {
    standIn("cmake",
            "echo '[1/2] Building CXX object a.o'; case \"$*\" in *--build*) echo 'FAILED: a.o'; echo 'a.cpp:1: error: no'; "
            "exit 1 ;; esac");
    const Outcome outcome = bench("test");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.output.find("FAILED: a.o\na.cpp:1: error: no\nbench: building failed"), std::string::npos)
        << outcome.output;
    EXPECT_EQ(outcome.output.find("[1/2]"), std::string::npos) << outcome.output;
}

} // namespace
} // namespace shadowbench
