#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "harness/runs/cell_file.h"
#include "harness/runs/manifest.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <cerrno>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::shards {
namespace {

RunOptions fewCells() {
    RunOptions options;
    options.scenes = {"dueling-frusta", "colonnade"};
    options.techniques = {"none", "sm-uniform", "pcss", "lod-switch"}; // the last two do not apply
    return options;
}

/// The scene after its text was changed.
std::vector<ManifestCell> plannedOf(const std::filesystem::path& folder, const std::string& box) {
    writeFile(folder / "scene.toml",
              "title = \"Box\"\ncamera = { eye = [2, 6, 7], target = [0, 0, 0], fovy = 45, near = 0.5, far = 40 }\n"
              "light = { kind = \"point\", centre = [1.7, 6.1, -2.3] }\n"
              "[[object]]\nmesh = { box = { size = [" +
                  box + "] } }\n");
    RunOptions options;
    options.scenes = {(folder / "scene.toml").string()};
    options.techniques = {"sm-uniform"};
    return plannedCells(options);
}

TEST(Manifest, HoldsEveryCellOnceInTheOrderOfTheRecords) {
    const std::vector<ManifestCell> cells = plannedCells(fewCells());
    ASSERT_EQ(cells.size(), 8U);
    EXPECT_EQ(cells[1].scene, "dueling-frusta");
    EXPECT_EQ(cells[1].variant, "sm-uniform");
    EXPECT_EQ(cells[4].scene, "colonnade");
    EXPECT_EQ(cells[4].variant, "none");
    std::set<std::string> ids;
    for (const ManifestCell& cell : cells) {
        EXPECT_EQ(cell.id.size(), 32U);
        ids.insert(cell.id);
    }
    EXPECT_EQ(ids.size(), cells.size());
}

TEST(Manifest, HasIdsThatChangeWithWhatIsMeasuredAndWithNothingElse) {
    const std::string id = plannedCells(fewCells())[1].id;
    EXPECT_EQ(plannedCells(fewCells())[1].id, id);
    RunOptions elsewhere = fewCells();
    elsewhere.out = "elsewhere";
    elsewhere.measure.images = "elsewhere/images";
    elsewhere.techniques = {"sm-uniform"};
    EXPECT_EQ(plannedCells(elsewhere)[0].id, id);
    RunOptions seed = fewCells();
    seed.measure.seed = 2;
    EXPECT_NE(plannedCells(seed)[1].id, id);
    RunOptions cost = fewCells();
    cost.measure.time = false;
    EXPECT_NE(plannedCells(cost)[1].id, id);
    RunOptions profile = fewCells();
    profile.profile = Profile::Standard;
    EXPECT_NE(plannedCells(profile)[1].id, id);
}

TEST(Manifest, HasIdsThatChangeWithTheScenesContent) {
    const TemporaryFolder folder;
    const std::vector<ManifestCell> before = plannedOf(folder.path(), "1, 1, 1");
    EXPECT_EQ(plannedOf(folder.path(), "1, 1, 1"), before);
    const std::vector<ManifestCell> after = plannedOf(folder.path(), "1, 2, 1");
    EXPECT_NE(after[0].id, before[0].id);
    EXPECT_NE(difference(before, after)->find("sm-uniform on scene has other inputs"), std::string::npos);
}

TEST(Manifest, ReadsBackEqualAndIsALineACell) {
    const TemporaryFolder folder;
    const std::vector<ManifestCell> cells = plannedCells(fewCells());
    writeManifest(folder.path(), cells);
    EXPECT_EQ(readManifest(folder.path()), cells);
    const std::string text = readFile(manifestFile(folder.path()));
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), cells.size());
}

TEST(Manifest, WithALineThatNamesAnotherFolderOrNoSeedIsRefusedAtThatLine) {
    const TemporaryFolder folder;
    writeManifest(folder.path(), plannedCells(fewCells()));
    const std::string text = readFile(manifestFile(folder.path()));
    const std::string id = readManifest(folder.path())[1].id;
    const std::vector<std::pair<std::string, std::string>> changes{{id, "../" + id.substr(3)},
                                                                   {id, ""},
                                                                   {"\"seed\":1", "\"seed\":1e300"},
                                                                   {"\"seed\":1", "\"seed\":-1"},
                                                                   {"\"cost\":[", "\"cost\":" + std::string(1000, '[')}};
    for (const auto& [from, to] : changes) {
        std::string changed = text;
        changed.replace(changed.find(from, changed.find('\n')), from.size(), to); // in the second line
        writeFile(manifestFile(folder.path()), changed);
        try {
            readManifest(folder.path());
            ADD_FAILURE() << to;
        } catch (const BadInput& error) {
            EXPECT_NE(std::string(error.what()).find("manifest.jsonl:2 is no line"), std::string::npos) << error.what();
        }
    }
}

TEST(MeasuredCells, HaveAnExitCodeThatARunCanEndWith) {
    const std::string line = text(MeasuredCell{"", test::hardRecord(), ExitCode::Transient});
    EXPECT_EQ(measuredCell(line).code, ExitCode::Transient);
    const std::string code = "\"exit_code\":75";
    for (const char* other : {"74", "-1", "1e300", "true", "null", "\"0\""}) {
        std::string changed = line;
        EXPECT_THROW(measuredCell(changed.replace(changed.find(code), code.size(), "\"exit_code\":" + std::string(other))),
                     BadInput)
            << other;
    }
    EXPECT_THROW(measuredCell("[" + line + "]"), BadInput);
    EXPECT_THROW(measuredCell(std::string(1000, '[')), BadInput);
}

TEST(Manifest, IsFrozen) {
    const TemporaryFolder folder;
    const std::vector<ManifestCell> cells = plannedCells(fewCells());
    freezeManifest(folder.path(), cells);
    EXPECT_NO_THROW(freezeManifest(folder.path(), cells));
    std::vector<ManifestCell> other = cells;
    for (ManifestCell& cell : other) cell.seed = 2;
    try {
        freezeManifest(folder.path(), other);
        FAIL() << "another manifest was taken";
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("seed is 1, not 2"), std::string::npos) << error.what();
    }
    EXPECT_EQ(readManifest(folder.path()), cells);
}

TEST(Manifest, NamesTheFirstDifference) {
    const std::vector<ManifestCell> cells = plannedCells(fewCells());
    std::vector<ManifestCell> other = cells;
    EXPECT_FALSE(difference(cells, other));
    other[2].variant = "pcss:taps=32+32";
    EXPECT_EQ(*difference(cells, other), "in cell 3, variant is \"pcss\", not \"pcss:taps=32+32\"");
    other = cells;
    other[0].commit = "another";
    EXPECT_NE(difference(cells, other)->find("not \"another\""), std::string::npos);
    other = cells;
    other.pop_back();
    EXPECT_EQ(*difference(cells, other), "there are 8 cells, not 7");
}

TEST(Manifest, IsRefusedByFileAndLineWhenItIsNone) {
    const TemporaryFolder folder;
    writeManifest(folder.path(), plannedCells(fewCells()));
    const std::string text = readFile(manifestFile(folder.path()));
    writeFile(manifestFile(folder.path()), text + "{\"id\": 3}\n");
    try {
        readManifest(folder.path());
        FAIL() << "read";
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("manifest.jsonl:9"), std::string::npos) << error.what();
    }
}

TEST(Shards, ArePartsOfNeighboursThatCoverEveryCellOnce) {
    for (const std::size_t cells : {0U, 1U, 7U, 76U, 1001U})
        for (const std::size_t count : {1U, 2U, 3U, 8U, 100U}) {
            std::size_t next = 0, least = cells, most = 0;
            for (std::size_t i = 1; i <= count; ++i) {
                const CellRange range = shardRange(std::to_string(i) + "/" + std::to_string(count), cells);
                EXPECT_EQ(range.first, next);
                next = range.last;
                least = std::min(least, range.last - range.first);
                most = std::max(most, range.last - range.first);
            }
            EXPECT_EQ(next, cells);
            EXPECT_LE(most - least, 1U) << cells << " cells, " << count << " shards";
        }
}

TEST(Shards, AndCellsThatAreNotThereAreRefused) {
    for (const char* text : {"", "1", "0/2", "3/2", "-1/2", "1/2/3", "1/0", "a/b", "1 /2", "/", "1/"})
        EXPECT_THROW(shardRange(text, 10), BadInput) << text;
    EXPECT_THROW(cellRange(0, 10), BadInput);
    EXPECT_THROW(cellRange(11, 10), BadInput);
    EXPECT_EQ(cellRange(10, 10).first, 9U);
}

TEST(Failures, OfTheMachineAreWorthARetryOthersAreNot) {
    for (const int error : {ENOSPC, EDQUOT, ENOMEM, EAGAIN, ESTALE})
        EXPECT_EQ(failureOf(error), Failure::Transient) << error;
    for (const int error : {EACCES, ENOENT, ENOTDIR, EROFS}) EXPECT_EQ(failureOf(error), Failure::Lasting) << error;
}

} // namespace
} // namespace shadowbench::shards
