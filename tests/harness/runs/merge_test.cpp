#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "harness/runs/cell_file.h"
#include "harness/runs/manifest.h"
#include "harness/runs/merge.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench::shards {
namespace {

namespace fs = std::filesystem;

/// Three cells of one run, and folders that hold some of them.
class Merge : public testing::Test {
protected:
    Merge() {
        for (int i = 0; i < 3; ++i) {
            Record record = test::hardRecord();
            record.variant = fmt::format("cell{}", i + 1);
            record.cell = fmt::format("{:032x}", i + 1);
            records_.push_back(record);
            ManifestCell cell;
            cell.id = fmt::format("{:032x}", 17 + i);
            cell.scene = record.scene;
            cell.variant = record.variant;
            cell.profile = record.profile;
            cell.cost = {"time"};
            cell.commit = record.commit;
            cell.program = record.program;
            manifest_.push_back(cell);
        }
    }

    fs::path folder(const std::string& name, const std::vector<std::size_t>& cells) const {
        fs::path folder = folder_.path() / name;
        writeManifest(folder, manifest_);
        for (const std::size_t i : cells) put(folder, i, records_[i]);
        return folder;
    }
    void put(const fs::path& folder, std::size_t i, const Record& record, ExitCode code = ExitCode::Pass) const {
        writeCell(folder, {manifest_[i].id, record, code});
    }
    static std::vector<std::string> lines(const Merged& merged) {
        std::vector<std::string> lines;
        for (const Record& record : merged.result.records) lines.push_back(toJson(record));
        return lines;
    }
    template <typename Kind>
    static std::string refusal(const std::vector<fs::path>& folders) {
        try {
            merge(folders);
        } catch (const Kind& error) {
            return error.what();
        }
        return "";
    }
    static bool names(const std::string& text, const std::vector<std::string>& words) {
        return std::all_of(words.begin(), words.end(), [&](const auto& word) { return text.find(word) != text.npos; });
    }

    TemporaryFolder folder_;
    std::vector<Record> records_;
    std::vector<ManifestCell> manifest_;
};

TEST_F(Merge, KeepsTheManifestsOrderWhateverTheFolders) {
    const fs::path a = folder("a", {2, 0}), b = folder("b", {1});
    const Merged merged = merge({a, b});
    EXPECT_TRUE(merged.missing.empty());
    EXPECT_EQ(merged.result.code, ExitCode::Pass);
    EXPECT_EQ(lines(merged), (std::vector{toJson(records_[0]), toJson(records_[1]), toJson(records_[2])}));
    EXPECT_EQ(lines(merge({b, a})), lines(merged));
}

/// A part that is killed between scoring and measuring costs leaves scores, which its next start goes on from.
TEST_F(Merge, TakesACellWithoutAllItsCostsForMissing) {
    manifest_[1].cost = {"time", "screen"};
    records_[1].otherScreen.reset();
    const Merged merged = merge({folder("all", {0, 1, 2})});
    ASSERT_EQ(merged.missing.size(), 1U);
    EXPECT_TRUE(names(merged.missing.front(), {"cell 2", "has scores, and not yet all costs"})) << merged.missing.front();
    EXPECT_TRUE(hasCosts(records_[1], {"time"}));
    EXPECT_FALSE(hasCosts(records_[1], {"time", "screen"}));
    EXPECT_FALSE(hasCost(records_[1], "instructions"));
}

TEST_F(Merge, NamesEveryMissingCell) {
    const Merged merged = merge({folder("a", {1})});
    ASSERT_EQ(merged.missing.size(), 2U);
    EXPECT_TRUE(names(merged.missing[0], {"cell 1,", "cell1 on dueling-frusta", manifest_[0].id})) << merged.missing[0];
    EXPECT_TRUE(names(merged.missing[1], {"cell 3,", "cell3"})) << merged.missing[1];
    EXPECT_TRUE(merged.result.records.empty());
}

TEST_F(Merge, CountsADamagedFileAsMissingUnlessAnotherFolderHasTheCell) {
    const fs::path a = folder("a", {0, 1, 2}), b = folder("b", {1});
    const std::string whole = readFile(cellFile(a, manifest_[1].id));
    writeFile(cellFile(a, manifest_[1].id), whole.substr(0, whole.size() / 2));
    EXPECT_TRUE(merge({a, b}).missing.empty());
    const Merged merged = merge({a});
    ASSERT_EQ(merged.missing.size(), 1U);
    EXPECT_TRUE(names(merged.missing[0], {cellFile(a, manifest_[1].id).string()})) << merged.missing[0];
}

TEST_F(Merge, TakesNoFileForAnotherCells) {
    const fs::path a = folder("a", {0, 1});
    fs::copy_file(cellFile(a, manifest_[0].id), cellFile(a, manifest_[2].id));
    EXPECT_EQ(merge({a}).missing.size(), 1U);
}

TEST_F(Merge, ExitsAsARunForTheFirstCellInError) {
    const fs::path a = folder("a", {0});
    Record error = test::unscored(Status::Error, "it failed");
    error.commit = manifest_[1].commit;
    error.environment = records_[0].environment;
    put(a, 1, error, ExitCode::Inconclusive);
    put(a, 2, error, ExitCode::Internal);
    const Merged merged = merge({a});
    EXPECT_TRUE(merged.missing.empty());
    EXPECT_EQ(merged.result.code, ExitCode::Inconclusive);
    EXPECT_EQ(merged.result.records.size(), 3U);
}

TEST_F(Merge, OfRepeatedCellsKeepsTheEarlierInEveryOrder) {
    const fs::path a = folder("a", {0, 1, 2}), b = folder("b", {});
    Record again = records_[1];
    again.time = "2026-01-02T03:04:04Z";
    again.values["cost.time.median"] = 99;
    put(b, 1, again);
    EXPECT_EQ(merge({a, b}).result.records[1].time, again.time);
    EXPECT_EQ(lines(merge({b, a})), lines(merge({a, b})));
    again.time = "2026-01-02T03:04:06Z";
    put(b, 1, again);
    EXPECT_EQ(merge({a, b}).result.records[1].time, records_[1].time) << "the first folder's is the earlier one";
}

TEST_F(Merge, RefusesRepeatedCellsWithOtherScores) {
    const fs::path a = folder("a", {0, 1, 2}), b = folder("b", {});
    Record again = records_[1];
    again.values["accuracy.leak"] = 0.0005;
    put(b, 1, again);
    EXPECT_TRUE(names(refusal<Inconclusive>({a, b}),
                      {cellFile(a, manifest_[1].id).string(), cellFile(b, manifest_[1].id).string()}));
    EXPECT_EQ(refusal<Inconclusive>({a, b}), refusal<Inconclusive>({b, a}));
}

TEST_F(Merge, RefusesMixedEnvironments) {
    const fs::path a = folder("a", {0, 1, 2});
    Record other = records_[2];
    other.environment.renderer = "llvmpipe (LLVM 19.1.0, 512 bits)";
    put(a, 2, other);
    EXPECT_TRUE(names(refusal<Inconclusive>({a}), {"renderer", "LLVM 15.0.6", "LLVM 19.1.0", manifest_[2].id}));
}

TEST_F(Merge, ComparesTheValgrindsOfCountedCellsOnly) {
    const fs::path a = folder("a", {0});
    std::vector<Record> counted{records_[1], records_[2]};
    for (Record& record : counted) record.environment.valgrind = "valgrind-3.19.0";
    put(a, 1, counted[0]);
    put(a, 2, counted[1]);
    EXPECT_TRUE(merge({a}).missing.empty());
    counted[1].environment.valgrind = "valgrind-3.20.0";
    put(a, 2, counted[1]);
    EXPECT_TRUE(names(refusal<Inconclusive>({a}), {"valgrind-3.19.0", "valgrind-3.20.0"}));
}

TEST_F(Merge, RefusesCellsOfAnotherCommit) {
    const fs::path a = folder("a", {0, 1, 2});
    Record other = records_[2];
    other.commit = "decaf";
    put(a, 2, other);
    EXPECT_TRUE(names(refusal<Inconclusive>({a}), {"decaf", "c0ffee", manifest_[2].id}));
}

TEST_F(Merge, RefusesCellsOfAnotherTreeWithChanges) {
    for (std::size_t i = 0; i < 3; ++i) manifest_[i].dirty = records_[i].dirty = true;
    const fs::path a = folder("a", {0, 1, 2});
    EXPECT_TRUE(merge({a}).missing.empty()) << "one tree";
    Record other = records_[2];
    other.program = "abcd";
    put(a, 2, other);
    EXPECT_TRUE(names(refusal<Inconclusive>({a}), {"another program of commit c0ffee with changes", manifest_[2].id}));
}

TEST_F(Merge, TellsATreeWithChangesFromTheCommitItself) {
    const fs::path a = folder("a", {0, 1, 2});
    Record other = records_[2];
    other.dirty = true;
    put(a, 2, other);
    EXPECT_TRUE(names(refusal<Inconclusive>({a}), {"by commit c0ffee with changes, the manifest is of c0ffee;"}));
    other.dirty = false;
    other.program = "abcd";
    put(a, 2, other);
    EXPECT_TRUE(names(refusal<Inconclusive>({a}), {"another program of commit c0ffee: its sources"}));
    manifest_[2].dirty = true;
    const fs::path b = folder("b", {0, 1, 2});
    EXPECT_TRUE(names(refusal<Inconclusive>({b}), {"by commit c0ffee, the manifest is of c0ffee with changes;"}));
}

TEST_F(Merge, WithoutAFolderSaysWhatItIsFor) {
    EXPECT_EQ(refusal<BadInput>({}), "merge joins the folders of a run in parts; name at least one");
}

TEST_F(Merge, DoesNotCompareWhereOtherRenderersRan) {
    const fs::path a = folder("a", {0, 1, 2});
    Record external = records_[2];
    external.technique = "external:my-engine";
    external.variant = "external:my-engine";
    external.external = ExternalInfo{};
    external.external->reported = ReportedCost{3.5};
    external.environment.renderer = "another machine's";
    put(a, 2, external);
    EXPECT_TRUE(merge({a}).missing.empty());
    EXPECT_FALSE(withoutTimings(external).external->reported);
}

TEST_F(Merge, RefusesFoldersOfDifferentRuns) {
    const fs::path a = folder("a", {0, 1, 2});
    manifest_[1].seed = 2;
    const fs::path b = folder("b", {});
    EXPECT_TRUE(names(refusal<BadInput>({a, b}), {a.string(), b.string(), "seed is 1, not 2"}));
    EXPECT_TRUE(names(refusal<BadInput>({a, folder_.path()}), {folder_.path().string(), "holds no manifest"}));
}

TEST_F(Merge, BringsTheImagesAlong) {
    const fs::path a = folder("a", {});
    writeFile(a / "images/scene/none/error.png", "picture");
    copyImages(a, folder_.path() / "out");
    copyImages(a, a);
    copyImages(folder("without", {}), folder_.path() / "none");
    EXPECT_FALSE(fs::exists(folder_.path() / "none"));
    EXPECT_EQ(readFile(folder_.path() / "out/images/scene/none/error.png"), "picture");
}

TEST(CellFile, ReadsBackEqualForEveryStatus) {
    const TemporaryFolder folder;
    for (const Record& record : test::recordOfEveryStatus()) {
        writeCell(folder.path(), {"abc", record, ExitCode::Inconclusive});
        const auto read = readCell(folder.path(), "abc");
        ASSERT_TRUE(read);
        EXPECT_EQ(toJson(read->record), toJson(parseRecord(toJson(record))));
        EXPECT_EQ(read->code, ExitCode::Inconclusive);
    }
    EXPECT_FALSE(readCell(folder.path(), "def"));
}

} // namespace
} // namespace shadowbench::shards
