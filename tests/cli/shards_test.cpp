// Runs in parts: manifests, shards, single cells, and what becomes of them when they are killed.
#include "base/files.h"
#include "harness/records/record.h"
#include "harness/runs/cell_file.h"
#include "harness/runs/manifest.h"
#include "harness/runs/merge.h"
#include "tests/support/program.h"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <random>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class Shards : public testing::Test {
protected:
    static void SetUpTestSuite() { truths_ = std::make_unique<Folder>(); }
    static void TearDownTestSuite() { truths_.reset(); }

    [[nodiscard]] std::string command(const std::string& out, const std::string& more = "") const {
        return "shadowbench run --quiet " + choice_ + " --cache " + cache_ + " --out " + (folder_ / out) + " " + more;
    }
    [[nodiscard]] Outcome run(const std::string& out, const std::string& more = "") const {
        return shell(command(out, more));
    }
    [[nodiscard]] Outcome merge(const std::string& folders, const std::string& out) const {
        return shell("cd " + (folder_ / "") + " && shadowbench merge " + folders + " --out " + out);
    }
    /// Records but for timings and dates.
    [[nodiscard]] std::vector<std::string> scores(const std::string& out) const {
        std::vector<std::string> lines;
        for (const Record& record : readRecords(folder_ / (out + "/results.jsonl")))
            lines.push_back(toJson(shards::withoutTimings(record)));
        return lines;
    }
    [[nodiscard]] std::string text(const std::string& file) const { return readFile(folder_ / file); }
    [[nodiscard]] std::vector<shards::ManifestCell> manifest(const std::string& out) const {
        return shards::readManifest(folder_ / out);
    }
    /// Cells that have a file; every one must be whole, under its own name.
    [[nodiscard]] std::size_t wholeCells(const std::string& out) const {
        std::size_t cells = 0;
        if (!fs::exists(folder_ / (out + "/cells"))) return cells;
        for (const auto& entry : fs::directory_iterator(folder_ / (out + "/cells"))) {
            if (entry.path().filename().string().starts_with(".")) continue; // temporary: no reader takes it for a cell
            EXPECT_NO_THROW(EXPECT_TRUE(shards::readCell(folder_ / out, entry.path().stem())));
            ++cells;
        }
        return cells;
    }

    static std::unique_ptr<Folder> truths_; // what POV-Ray takes seconds for is computed once for all tests
    Folder folder_;
    std::string cache_ = truths_->cache();
    std::string point_ = folder_.write("point.toml", tinyScene());
    std::string area_ = folder_.write(
        "area.toml", tinyScene("{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [0.9, 0, 0], v = [0, 0, 0.9] }"));
    std::string choice_ = "--cost none --scene " + point_ + " --scene " + area_ +
                          " --technique none --technique sm-uniform --technique volume-zfail --technique pcss "
                          "--technique sm-history --technique lod-switch";
};

std::unique_ptr<Folder> Shards::truths_;

TEST_F(Shards, MergedEqualAWholeRunRecordForRecord) {
    ASSERT_EQ(run("whole").code, 0);
    for (const int count : {2, 5}) { // five part scenes, too
        const std::string out = "parts" + std::to_string(count);
        for (int i = count; i > 0; --i) {
            const Outcome outcome = run(out, "--shard " + std::to_string(i) + "/" + std::to_string(count));
            ASSERT_EQ(outcome.code, 0) << outcome.output;
            EXPECT_NE(outcome.output.find(" measured, 0 were there"), std::string::npos) << outcome.output;
        }
        const Outcome merged = merge(out, out);
        ASSERT_EQ(merged.code, 0) << merged.output;
        EXPECT_EQ(scores(out), scores("whole"));
        EXPECT_EQ(text(out + "/report.md"), text("whole/report.md")); // holds no date
    }
}

TEST_F(Shards, OfSeveralFoldersMergeToTheSameBytesInEveryOrder) {
    for (const std::string i : {"1", "2", "3"}) ASSERT_EQ(run("part" + i, "--shard " + i + "/3").code, 0);
    ASSERT_EQ(merge("part1 part2 part3", "forward").code, 0);
    ASSERT_EQ(merge("part3 part1 part2", "backward").code, 0);
    EXPECT_EQ(text("forward/results.jsonl"), text("backward/results.jsonl"));
    EXPECT_EQ(text("forward/report.md"), text("backward/report.md"));
    EXPECT_EQ(merge("part1 part2 part3", "").code, 2) << "no --out";
}

TEST_F(Shards, WriteTheManifestFirstAndMeasureNothingWithItAlone) {
    cache_ = folder_ / "cache";
    ASSERT_EQ(run("out", "--manifest").code, 0);
    EXPECT_EQ(manifest("out").size(), 12U);
    EXPECT_FALSE(fs::exists(folder_ / "out/cells"));
    EXPECT_FALSE(fs::exists(cache_)); // no truth either
}

TEST_F(Shards, RefuseOtherOptionsThanTheManifests) {
    ASSERT_EQ(run("out", "--manifest").code, 0);
    const std::string before = text("out/manifest.jsonl");
    const std::vector<std::pair<std::string, std::string>> others{
        {"--seed 2", "seed is 1, not 2"},
        {"--images", "images is false, not true"},
        {"--technique vsm", "in cell 7, scene is \"area\", not \"point\""},
        {"--profile standard", "profile is \"gate\", not \"standard\""},
    };
    for (const auto& [options, difference] : others) {
        const Outcome outcome = run("out", "--shard 1/2 " + options);
        EXPECT_EQ(outcome.code, 2) << options;
        EXPECT_NE(outcome.output.find(difference), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(text("out/manifest.jsonl"), before);
    EXPECT_FALSE(fs::exists(folder_ / "out/cells"));
}

TEST_F(Shards, WithInvalidNumbersAreRefusedAndNothingIsWritten) {
    for (const char* part : {"--shard 3/2", "--shard 0/2", "--shard 1", "--shard ''", "--cell 0", "--cell 13",
                             "--shard 1/2 --cell 3", "--cell 3 --manifest"})
        EXPECT_EQ(run("out", part).code, 2) << part;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Shards, KeepFinishedCellsAndMeasureDamagedOnesAgain) {
    ASSERT_EQ(run("out", "--shard 1/2").code, 0);
    const auto file = [&](std::size_t i) { return shards::cellFile(folder_ / "out", manifest("out")[i].id); };
    const std::string first = readFile(file(0)), second = readFile(file(1));
    writeFile(file(1), second.substr(0, 100));
    const Outcome again = run("out", "--shard 1/2");
    ASSERT_EQ(again.code, 0) << again.output;
    EXPECT_NE(again.output.find("cells: 1 measured, 5 were there"), std::string::npos) << again.output;
    EXPECT_EQ(readFile(file(0)), first); // date and all: it was not measured again
    EXPECT_NO_THROW(shards::readCell(folder_ / "out", manifest("out")[1].id));
}

TEST_F(Shards, CellsAreMeasuredOneByOne) {
    ASSERT_EQ(run("out", "--cell 2").code, 0);
    EXPECT_EQ(wholeCells("out"), 1U);
    const auto cell = shards::readCell(folder_ / "out", manifest("out")[1].id);
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->record.variant, "sm-uniform");
    const Outcome merged = merge("out", "out");
    EXPECT_EQ(merged.code, 5);
    EXPECT_NE(merged.output.find("missing: cell 1, none on point"), std::string::npos) << merged.output;
    EXPECT_NE(merged.output.find("11 of the manifest's cells are missing"), std::string::npos) << merged.output;
    EXPECT_FALSE(fs::exists(folder_ / "out/results.jsonl"));
}

TEST_F(Shards, GetTheirInstructionsCellByCell) {
    choice_ = "--cost instructions --scene " + point_ + " --technique sm-uniform --technique volume-zfail";
    ASSERT_EQ(run("out", "--cell 2").code, 0);
    const auto cell = shards::readCell(folder_ / "out", manifest("out")[1].id);
    ASSERT_TRUE(cell && cell->record.values["cost.instructions"]);
    EXPECT_EQ(cell->record.environment.valgrind->substr(0, 9), "valgrind-");
    EXPECT_FALSE(cell->record.values["cost.time.median"]);
}

TEST_F(Shards, AreWorthARetryWhenAToolIsKilled) {
    cache_ = folder_ / "cache"; // the tool is needed for what no cache has
    ASSERT_EQ(shell("mkdir " + (folder_ / "bin")).code, 0);
    const std::string tool =
        folder_.write("bin/povray", "#!/bin/sh\n"
                                    "case \"$*\" in *version*) exec /usr/bin/povray \"$@\";; esac\n"
                                    "[ -e " +
                                        (folder_ / "freed") + " ] && exec /usr/bin/povray \"$@\"\nkill -KILL $$\n");
    fs::permissions(tool, fs::perms::owner_all);
    const std::string path = "PATH=" + (folder_ / "bin") + ":$PATH ";
    const Outcome killed = shell(path + command("out", "--shard 1/1"));
    EXPECT_EQ(killed.code, 75) << killed.output;
    EXPECT_NE(killed.output.find("worth a retry: none on area: POV-Ray was killed by signal 9"), std::string::npos)
        << killed.output;
    EXPECT_EQ(wholeCells("out"), 7U); // all on the point light, and what does not apply to the area light
    EXPECT_EQ(merge("out", "out").code, 5);
    folder_.write("freed", "");
    const Outcome again = shell(path + command("out", "--shard 1/1"));
    EXPECT_EQ(again.code, 0) << again.output;
    EXPECT_NE(again.output.find("cells: 5 measured, 7 were there"), std::string::npos) << again.output;
    EXPECT_EQ(merge("out", "out").code, 0);
}

TEST_F(Shards, LeaveTheJudgementOfAnErrorThatRecursToMerge) {
    ASSERT_EQ(shell("mkdir " + (folder_ / "bin")).code, 0);
    const std::string tool = folder_.write("bin/valgrind", "#!/bin/sh\n[ \"$1\" = --version ] && echo valgrind-0 && exit 0\n"
                                                           "echo this machine is not supported\nexit 1\n");
    fs::permissions(tool, fs::perms::owner_all);
    choice_ = "--cost instructions --scene " + point_ + " --technique sm-uniform --technique lod-switch";
    const std::string path = "PATH=" + (folder_ / "bin") + ":$PATH ";
    const Outcome measured = shell(path + command("out", "--shard 1/1"));
    EXPECT_EQ(measured.code, 0) << measured.output;
    EXPECT_NE(measured.output.find("error, kept for merge: sm-uniform on point"), std::string::npos) << measured.output;
    const Outcome merged = merge("out", "out");
    EXPECT_EQ(merged.code, 5) << merged.output; // as of the whole run
    EXPECT_NE(merged.output.find("error: sm-uniform on point: counting instructions"), std::string::npos) << merged.output;
    const Outcome again = shell(path + command("out", "--shard 1/1")); // an error is no finished cell
    EXPECT_NE(again.output.find("cells: 1 measured, 1 were there"), std::string::npos) << again.output;
}

TEST_F(Shards, NameTheFileThatCannotBeWrittenAndLeaveNoPartialOne) {
    ASSERT_EQ(run("out", "--shard 2/12").code, 0); // its truth is in the cache now
    const Outcome outcome =
        shell("trap '' XFSZ; ulimit -f 1; " + command("out", "--shard 1/12")); // 512 or 1024 bytes a file
    EXPECT_EQ(outcome.code, 1) << outcome.output;
    const std::string file = shards::cellFile(folder_ / "out", manifest("out")[0].id);
    EXPECT_NE(outcome.output.find("cannot write " + file + ": File too large"), std::string::npos) << outcome.output;
    EXPECT_FALSE(fs::exists(file));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out/cells"), fs::directory_iterator()), 1) << "the one before";
}

/// $SHADOWBENCH_KILLS moments, else few; the same in every run of the tests, as shares of an undisturbed run's time.
std::vector<double> killMoments() {
    const char* wanted = std::getenv("SHADOWBENCH_KILLS");
    std::vector<double> moments(wanted == nullptr ? 4 : static_cast<std::size_t>(std::atoi(wanted)));
    std::mt19937 random(20261122); // NOLINT: the same moments each time
    std::uniform_real_distribution<double> share(0, 1);
    for (double& moment : moments) moment = share(random);
    return moments;
}

TEST_F(Shards, KilledAtAnyMomentLeaveWholeCellsAndGoOn) {
    using Clock = std::chrono::steady_clock;
    ASSERT_EQ(run("warm", "--manifest").code, 0);
    ASSERT_EQ(run("warm", "--shard 1/1").code, 0); // truths: they would be most of the time
    const auto start = Clock::now();
    ASSERT_EQ(run("whole", "--shard 1/1").code, 0);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    ASSERT_EQ(merge("whole", "whole").code, 0);

    int unfinished = 0;
    for (const double moment : killMoments()) {
        shell("timeout -s KILL " + std::to_string(moment * seconds) + " " + command("killed", "--shard 1/1"));
        const std::size_t whole = wholeCells("killed");
        const Outcome merged = merge("killed", "killed");
        EXPECT_EQ(merged.code == 0, whole == 12U) << merged.output;
        if (whole < 12U) {
            ++unfinished;
            EXPECT_FALSE(fs::exists(folder_ / "killed/results.jsonl"));
        }
        const Outcome resumed = run("killed", "--shard 1/1");
        EXPECT_EQ(resumed.code, 0) << resumed.output;
        EXPECT_NE(resumed.output.find(", " + std::to_string(whole) + " were there"), std::string::npos) << resumed.output;
        EXPECT_EQ(merge("killed", "killed").code, 0);
        EXPECT_EQ(scores("killed"), scores("whole"));
        fs::remove_all(folder_ / "killed");
    }
    EXPECT_GT(unfinished, 0) << "no kill came in time";
}

} // namespace
} // namespace shadowbench
