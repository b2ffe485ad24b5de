// cmake/version.cmake in a repository of its own: which changes make the program another one than its commit's.
#include "base/files.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class EmbeddedVersion : public testing::Test {
protected:
    EmbeddedVersion() {
        for (const char* folder : {"base", "results/published", "results/reference"}) fs::create_directories(tree_ / folder);
        for (const char* file : {"base/a.cpp", "results/published/report.md", "results/reference/simple.json"})
            tree_.write(file, "as committed\n");
        const Outcome made =
            shell("cd " + tree_ / "" + " && git init -q && git add . && git -c user.name=a -c user.email=a@b commit -qm a");
        EXPECT_EQ(made.code, 0) << made.output;
    }

    [[nodiscard]] std::string embedded() const {
        fs::create_directories(out_ / "");
        const Outcome outcome = shell("cmake -DROOT=" + tree_ / "" + " -DOUT=" + out_ / "" + " -DVERSION=1.2.3 -P " +
                                      SOURCE_FOLDER "/cmake/version.cmake");
        EXPECT_EQ(outcome.code, 0) << outcome.output;
        return readFile(out_ / "embedded_commit.h");
    }

    static bool isDirty(const std::string& header) { return header.find("dirty = true") != std::string::npos; }

    Folder tree_, out_;
};

TEST_F(EmbeddedVersion, ACleanTreeIsItsCommit) {
    const std::string header = embedded();
    EXPECT_NE(header.find("version = \"1.2.3\""), std::string::npos) << header;
    EXPECT_EQ(header.find("commit = \"unknown\""), std::string::npos) << header;
    EXPECT_FALSE(isDirty(header)) << header;
}

TEST_F(EmbeddedVersion, AChangedSourceOrGoldenReferenceIsAnotherProgram) {
    tree_.write("base/a.cpp", "changed\n");
    EXPECT_TRUE(isDirty(embedded()));
    tree_.write("base/a.cpp", "as committed\n");
    EXPECT_FALSE(isDirty(embedded()));
    tree_.write("results/reference/simple.json", "changed\n");
    EXPECT_TRUE(isDirty(embedded()));
}

TEST_F(EmbeddedVersion, ResultsThatAreMadeAnewAreNoChangeOfTheProgram) {
    tree_.write("results/published/report.md", "made anew\n");
    EXPECT_FALSE(isDirty(embedded()));
    fs::remove(tree_ / "results/published/report.md");
    EXPECT_FALSE(isDirty(embedded()));
}

} // namespace
} // namespace shadowbench
