// cmake/version.cmake in a repository of its own: which changes make the program another one than its commit's.
#include "base/files.h"
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class EmbeddedVersion : public testing::Test {
protected:
    EmbeddedVersion() {
        for (const char* folder : {"base", "cmake", "harness/metrics", "results/published", "results/reference"})
            fs::create_directories(tree_ / folder);
        tree_.write("cmake/layers.txt", "# lowest first\nbase: | png\nharness/metrics: base\n");
        for (const char* file :
             {"base/a.cpp", "harness/metrics/b.cpp", "results/published/report.md", "results/reference/simple.json"})
            tree_.write(file, "as committed\n");
        const Outcome made =
            shell("cd " + tree_ / "" + " && git init -q && git add . && git -c user.name=a -c user.email=a@b commit -qm a");
        EXPECT_EQ(made.code, 0) << made.output;
    }

    [[nodiscard]] std::string embedded(const char* header = "embedded_commit.h") const {
        fs::create_directories(out_ / "");
        const Outcome outcome = shell("cmake -DROOT=" + tree_ / "" + " -DOUT=" + out_ / "" + " -DVERSION=1.2.3 -P " +
                                      SOURCE_FOLDER "/cmake/version.cmake");
        EXPECT_EQ(outcome.code, 0) << outcome.output;
        return readFile(out_ / header);
    }

    static bool isDirty(const std::string& header) { return header.find("dirty = true") != std::string::npos; }

    /// A text of the header, such as the hash `program`.
    static std::string valueOf(const std::string& header, const std::string& name) {
        const std::size_t begin = header.find(name + " = \"") + name.size() + 4;
        return header.substr(begin, header.find('"', begin) - begin);
    }

    Folder tree_, out_;
};

TEST_F(EmbeddedVersion, SourcesAreHashedWhateverTheCommit) {
    const std::string before = embedded();
    EXPECT_EQ(valueOf(before, "program").size(), 32U);
    tree_.write("results/published/report.md", "made anew\n");
    tree_.write("a page.md", "of the documentation\n");
    EXPECT_EQ(valueOf(embedded(), "program"), valueOf(before, "program"));
    tree_.write("results/reference/lock.json", "another truth is the right one\n");
    const std::string locked = embedded();
    EXPECT_NE(valueOf(locked, "program"), valueOf(before, "program")) << "the lock is built in";
    tree_.write("base/a.cpp", "changed\n");
    EXPECT_NE(valueOf(embedded(), "program"), valueOf(locked, "program"));
    EXPECT_EQ(valueOf(embedded(), "metric_code"), valueOf(before, "metric_code"));
    tree_.write("harness/metrics/b.cpp", "changed\n");
    EXPECT_NE(valueOf(embedded(), "metric_code"), valueOf(before, "metric_code"));
}

/// Which oracles' hashes change with a file: entries of the cache that these name are computed anew.
TEST_F(EmbeddedVersion, EachOracleHasAHashOfWhatComputesItsNumbers) {
    const std::vector<std::string> names{"exact_sources", "plan_sources", "area_sources", "sampled_sources"};
    const std::vector<std::pair<std::string, std::vector<std::string>>> files{
        {"groundtruth/cgal/hard/exact.cpp", names},
        {"groundtruth/new.cpp", names},
        {"scene/camera.cpp", names},
        {"base/random.h", names},
        {"groundtruth/cgal/plan/plan_view.cpp", {"plan_sources"}},
        {"groundtruth/cgal/area/area.cpp", {"area_sources", "sampled_sources"}},
        {"groundtruth/povray/scene_text.cpp", {"sampled_sources"}},
        {"groundtruth/certify/certificate.cpp", {"sampled_sources"}},
        {"scene/sky_sampler.cpp", {"sampled_sources"}},
        {"base/image_io.cpp", {"sampled_sources"}},
        {"groundtruth/store/cache.cpp", {}},
        {"scene/scene.h", {}}};
    std::string before = embedded("embedded_oracle_sources.h");
    for (const auto& [file, changed] : files) {
        fs::create_directories(fs::path(tree_ / file).parent_path());
        tree_.write(file, "changed\n");
        const std::string now = embedded("embedded_oracle_sources.h");
        for (const std::string& name : names) {
            EXPECT_EQ(valueOf(now, name).size(), 12U);
            EXPECT_EQ(valueOf(now, name) != valueOf(before, name), std::ranges::count(changed, name) > 0) << file << name;
        }
        before = now;
    }
}

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
