// What `--base` may name, and how a commit is built: with stand-ins for the tools.
#include "gate/baseline.h"

#include "base/error.h"
#include "base/files.h"
#include "base/folder_lock.h"
#include "base/git.h"
#include "base/temporary_folder.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>
#include <unistd.h>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

void writeProgram(const fs::path& file, const std::string& text) {
    writeFile(file, "#!/bin/sh\n" + text);
    fs::permissions(file, fs::perms::owner_all);
}

/// In a folder of its own, with its own tools before those of the system.
class ABaseline : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_.path() / "work");
        fs::current_path(folder_.path() / "work");
        setenv("PATH", ((folder_.path() / "bin").string() + ":" + path_).c_str(), 1);
    }
    void TearDown() override {
        setenv("PATH", path_.c_str(), 1);
        fs::current_path(before_);
    }
    [[nodiscard]] Baseline find(const std::string& text, const std::string& headsProgram = "") {
        return findBaseline(text, folder_.path() / "cache", headsProgram,
                            [&](double, std::string_view line) { lines_.emplace_back(line); });
    }
    [[nodiscard]] std::string complaint(const std::string& text) {
        try {
            (void)find(text);
        } catch (const Inconclusive& error) {
            return error.what();
        }
        return "none";
    }
    /// A repository of one commit, "v1".
    void makeRepository() const {
        writeFile("file", "text");
        const std::vector<std::vector<std::string>> steps{
            {"init", "-q", "."},
            {"add", "."},
            {"-c", "user.name=a", "-c", "user.email=a@b", "commit", "-q", "-m", "first"},
            {"tag", "v1"}};
        for (const auto& step : steps) ASSERT_TRUE(git(".", step)) << step[0];
    }
    /// `build`: what it does in the folder that it builds in. `program`: what the sources make, by their own hash.
    void makeCmake(const std::string& build, const std::string& program = "") const {
        writeProgram(folder_.path() / "bin/cmake",
                     "echo \"cmake $1\"\necho \"$*\" >>" + (folder_.path() / "built").string() +
                         "\nif [ \"$1\" = --build ]; then mkdir -p \"$2/embedded\"; echo 'program = \"" + program +
                         "\"' >\"$2/embedded/embedded_commit.h\"; fi\n"
                         "[ \"$1\" = -E ] || exit 0\n"
                         "while [ \"$1\" != --build ]; do shift; done\nmkdir -p \"$2\"; cd \"$2\"\n" +
                         build);
    }

    TemporaryFolder folder_;
    fs::path before_ = fs::current_path();
    std::string path_ = std::getenv("PATH");
    std::vector<std::string> lines_;
};

TEST_F(ABaseline, IsAProgramOrRecordsOrAFolderOfEither) {
    writeProgram("build/shadowbench", "");
    writeFile("run/results.jsonl", "{}\n");
    EXPECT_EQ(find("build/shadowbench").kind, Baseline::Kind::Program);
    EXPECT_EQ(find("build").file, "build/shadowbench");
    EXPECT_EQ(find("build").name, "build");
    EXPECT_EQ(find("run").kind, Baseline::Kind::Records);
    EXPECT_EQ(find("run").file, "run/results.jsonl");
    EXPECT_EQ(find("run/results.jsonl").kind, Baseline::Kind::Records);
}

TEST_F(ABaseline, ThatIsNothingOrNowhereIsInconclusive) {
    EXPECT_NE(complaint("").find("nothing to compare with"), std::string::npos);
    EXPECT_NE(complaint("v1").find("no build folder, no records and no git revision here"), std::string::npos);
    makeRepository();
    EXPECT_NE(complaint("v2").find("the base \"v2\" is no build folder"), std::string::npos);
    fs::create_directory("empty");
    EXPECT_NE(complaint("empty").find("the base \"empty\" is no build folder"), std::string::npos);
}

TEST_F(ABaseline, ThatIsAPathAndARevisionIsRefused) {
    makeRepository();
    makeCmake("printf '#!/bin/sh\\n' >shadowbench; chmod +x shadowbench\n");
    writeFile("v1/results.jsonl", "{}\n");
    EXPECT_THROW(find("v1"), BadInput);
    EXPECT_EQ(find("./v1").kind, Baseline::Kind::Records);
}

TEST_F(ABaseline, ThatAShallowCloneLacksSaysSo) {
    fs::create_directory("whole");
    fs::current_path("whole");
    makeRepository();
    fs::current_path("..");
    ASSERT_TRUE(git(".", {"clone", "-q", "--depth", "1", "file://" + (fs::current_path() / "whole").string(), "shallow"}));
    fs::current_path("shallow");
    EXPECT_NE(complaint("v0").find("this clone is shallow: fetch the whole history"), std::string::npos) << complaint("v0");
}

TEST_F(ABaseline, ACommitIsBuiltOnce) {
    makeRepository();
    makeCmake("printf '#!/bin/sh\\n' >shadowbench; chmod +x shadowbench\n");
    const Baseline first = find("v1"), second = find("v1");
    EXPECT_EQ(first.kind, Baseline::Kind::Program);
    EXPECT_TRUE(first.name.starts_with("v1 (")) << first.name;
    EXPECT_EQ(first.file, second.file);
    EXPECT_EQ(readFile(first.file), "#!/bin/sh\n");
    EXPECT_EQ(access(first.file.c_str(), X_OK), 0);
    EXPECT_EQ(lines_, (std::vector<std::string>{"cmake -S", "cmake -E"})) << "once, and its lines are progress";
}

TEST_F(ABaseline, ACommitThatMakesTheHeadsProgramIsNotBuilt) {
    makeRepository();
    makeCmake("printf '#!/bin/sh\\n' >shadowbench; chmod +x shadowbench\n", "c0ffee");
    const Baseline same = find("v1", "c0ffee");
    EXPECT_EQ(same.kind, Baseline::Kind::HeadsProgram);
    EXPECT_EQ(same.commit, firstLine(git(".", {"rev-parse", "v1"})));
    EXPECT_TRUE(same.name.starts_with("v1 (")) << same.name;
    EXPECT_EQ(lines_, (std::vector<std::string>{"cmake -S", "cmake --build"}));

    EXPECT_EQ(find("v1", "decaf").kind, Baseline::Kind::Program) << "of another hash";
    EXPECT_EQ(find("v1", "c0ffee").kind, Baseline::Kind::Program) << "one that is there need not be hashed";
}

TEST_F(ABaseline, ACommitFromBeforeProgramsHadAHashIsBuilt) {
    makeRepository();
    makeCmake("printf '#!/bin/sh\\n' >shadowbench; chmod +x shadowbench\n");
    EXPECT_EQ(find("v1", "c0ffee").kind, Baseline::Kind::Program);
}

TEST_F(ABaseline, ThatAnotherGateBuildsIsWaitedForAndNotBuiltAgain) {
    makeRepository();
    makeCmake("printf '#!/bin/sh\\n' >shadowbench; chmod +x shadowbench\n");
    const fs::path program = find("v1").file;
    fs::rename(program, "built");
    std::optional<FolderLock> other(program.parent_path());
    std::vector<std::string> lines;
    (void)findBaseline("v1", folder_.path() / "cache", "", [&](double, std::string_view line) {
        lines.emplace_back(line);
        fs::rename("built", program);
        other.reset();
    });
    EXPECT_EQ(lines, std::vector<std::string>{"waiting for another gate that builds it"});
}

TEST_F(ABaseline, WhereverTheCompilersCacheIsTheBuildHasIt) {
    makeRepository();
    makeCmake("printf '#!/bin/sh\\n' >shadowbench; chmod +x shadowbench\n");
    const char* before = std::getenv("CCACHE_DIR");
    const std::string kept = before != nullptr ? before : "";
    const auto built = [&] {
        fs::remove_all(folder_.path() / "cache");
        (void)find("v1");
        const std::string text = readFile(folder_.path() / "built");
        fs::remove(folder_.path() / "built");
        return text;
    };
    setenv("CCACHE_DIR", "/somewhere", 1);
    EXPECT_NE(built().find("CCACHE_DIR=/somewhere "), std::string::npos);
    unsetenv("CCACHE_DIR");
    const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
    setenv("HOME", "/home/someone", 1);
    EXPECT_NE(built().find("CCACHE_DIR=/home/someone/.cache/ccache "), std::string::npos);
    unsetenv("HOME");
    EXPECT_NE(built().find("CCACHE_DIR=/root/.cache/ccache "), std::string::npos);
    home.empty() ? unsetenv("HOME") : setenv("HOME", home.c_str(), 1);
    if (before != nullptr) setenv("CCACHE_DIR", kept.c_str(), 1);
}

TEST_F(ABaseline, ThatCannotBeBuiltSaysTheLastLines) {
    makeRepository();
    makeCmake("i=0; while [ $i -lt 30 ]; do i=$((i + 1)); echo line $i.; done; exit 1\n");
    const std::string failed = complaint("v1");
    EXPECT_NE(failed.find("building the base, commit "), std::string::npos) << failed;
    EXPECT_NE(failed.find("line 30."), std::string::npos) << failed;
    EXPECT_EQ(failed.find("line 10."), std::string::npos) << failed;
    makeCmake("kill -9 $$\n");
    EXPECT_NE(complaint("v1").find("building the base, commit "), std::string::npos);
}

TEST_F(ABaseline, WithoutACompilerNamesThePackage) {
    makeRepository();
    fs::create_directories(folder_.path() / "bin");
    fs::create_symlink("/usr/bin/git", folder_.path() / "bin/git");
    setenv("PATH", (folder_.path() / "bin").c_str(), 1);
    EXPECT_NE(complaint("v1").find("building the base needs c++, which is not installed"), std::string::npos);
    setenv("PATH", "/nowhere", 1);
    EXPECT_NE(complaint("v1").find("no git revision here"), std::string::npos) << "there is no git to ask";
}

} // namespace
} // namespace shadowbench::gate
