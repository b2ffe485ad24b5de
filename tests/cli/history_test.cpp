// The history of a small repository, as a user keeps it.
#include "base/files.h"
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace shadowbench {
namespace {

class History : public ::testing::Test {
protected:
    void SetUp() override {
        const Outcome made = git("init --quiet");
        ASSERT_EQ(made.code, 0) << made.output;
        for (int i = 0; i < 4; ++i) {
            const std::string date = "2026-01-0" + std::to_string(i + 1) + "T12:00:00Z";
            ASSERT_EQ(git("commit --quiet --allow-empty -m 'step " + std::to_string(i) + "'", date).code, 0);
            std::string hash = git("rev-parse HEAD").output;
            hash.pop_back();
            hashes_.push_back(hash);
        }
    }

    [[nodiscard]] Outcome git(const std::string& what, const std::string& date = "2026-01-01T12:00:00Z") const {
        return shell("GIT_COMMITTER_DATE=" + date + " GIT_CONFIG_GLOBAL=/dev/null git -C " + folder_ / "" +
                     " -c user.name=tester -c user.email=tester@example.org " + what);
    }

    /// A file with a record of `commit` that leaks.
    [[nodiscard]] std::string records(const std::string& commit, double leak, bool dirty = false) const {
        Record record;
        record.scene = "dueling-frusta";
        record.technique = record.variant = "sm-uniform";
        record.profile = "gate";
        record.width = record.height = 256;
        record.frames = 68;
        record.commit = commit;
        record.dirty = dirty;
        record.time = "2026-02-01T00:00:00Z";
        record.values["accuracy.leak"] = leak;
        record.values["accuracy.primary_mismatch"] = 0;
        std::string file = folder_ / "run/results.jsonl"; // not const, so that it is moved
        writeRecords(file, {record});
        return file;
    }

    [[nodiscard]] Outcome add(const std::string& file, const std::string& more = "") const {
        return shell("shadowbench history add " + file + " --to " + (folder_ / "history") + " " + more);
    }
    [[nodiscard]] Outcome show(const std::string& more = "") const {
        return shell("shadowbench history show --from " + (folder_ / "history") + " " + more);
    }
    [[nodiscard]] std::size_t files() const {
        const std::filesystem::path history = folder_ / "history";
        if (!std::filesystem::exists(history)) return 0;
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(history), {}));
    }

    Folder folder_;
    std::vector<std::string> hashes_;
};

TEST_F(History, RecordsAreKeptByteForByteUnderACommitsDateOnce) {
    const std::string file = records(hashes_[1], 0.1);
    const Outcome outcome = add(file);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::string kept = outcome.output.substr(0, outcome.output.size() - 1);
    EXPECT_NE(kept.find("/20260102T120000Z-" + hashes_[1].substr(0, 12) + "-"), std::string::npos) << kept;
    EXPECT_EQ(readFile(kept), readFile(file));

    const Outcome again = add(folder_ / "run"); // the folder of the run will do
    EXPECT_EQ(again.code, 0);
    EXPECT_NE(again.output.find("already"), std::string::npos);
    EXPECT_EQ(files(), 1U);
    EXPECT_EQ(add(records(hashes_[1], 0.2)).code, 0); // other records of the same commit stand beside them
    EXPECT_EQ(files(), 2U);
}

TEST_F(History, WhatIsNotOfOneKnownCleanCommitIsRefused) {
    EXPECT_EQ(add(records(std::string(40, 'a'), 0.1)).code, 2); // no such commit
    EXPECT_EQ(add(records("unknown", 0.1)).code, 2);            // built outside a clone
    const Outcome dirty = add(records(hashes_[0], 0.1, true));
    EXPECT_EQ(dirty.code, 2);
    EXPECT_NE(dirty.output.find("--dirty"), std::string::npos) << dirty.output;

    const std::string file = records(hashes_[0], 0.1);
    std::vector<Record> mixed = readRecords(file);
    mixed.push_back(mixed[0]);
    mixed[1].commit = hashes_[1];
    writeRecords(file, mixed);
    EXPECT_EQ(add(file).code, 2);
    writeRecords(file, {});
    EXPECT_EQ(add(file).code, 2);
    EXPECT_EQ(files(), 0U);

    const Folder elsewhere;
    EXPECT_EQ(shell("shadowbench history add " + records(hashes_[0], 0.1) + " --to " + (elsewhere / "history")).code, 2);
    EXPECT_EQ(add(records(hashes_[0], 0.1, true), "--dirty").code, 0);
}

TEST_F(History, RowsOfAnotherRendererAreOfItsOwnCommits) {
    const auto ofRenderer = [&](const std::string& revision, double leak) {
        const std::string file = records(std::string(40, 'a'), leak, true); // of this program, which its owner need not have
        std::vector<Record> changed = readRecords(file);
        changed[0].technique = changed[0].variant = "external:engine";
        changed[0].external = ExternalInfo{.title = "", .source = "", .reported = {}, .revision = revision};
        writeRecords(file, changed);
        return file;
    };
    ASSERT_EQ(git("tag -a v1 -m v1 " + hashes_[0]).code, 0);
    const std::string described = git("describe " + hashes_[3]).output;
    ASSERT_TRUE(described.starts_with("v1-3-g")) << described;
    const Outcome last = add(ofRenderer(described.substr(0, described.size() - 1), 0.4));
    ASSERT_EQ(last.code, 0) << last.output;
    EXPECT_NE(last.output.find("/20260104T120000Z-" + hashes_[3].substr(0, 12)), std::string::npos) << last.output;
    ASSERT_EQ(add(ofRenderer(hashes_[0].substr(0, 7), 0.1)).code, 0);
    const auto json = nlohmann::json::parse(show("--format json").output);
    ASSERT_EQ(json["commits"].size(), 2U);
    EXPECT_EQ(json["commits"][0]["commit"], hashes_[0]);
    EXPECT_EQ(json["changes"].at(0)["suspects"], 3);
    const Outcome dirty = add(ofRenderer(hashes_[1].substr(0, 7) + "-dirty", 0.2));
    EXPECT_EQ(dirty.code, 2);
    EXPECT_NE(dirty.output.find("--dirty"), std::string::npos) << dirty.output;
    EXPECT_EQ(add(ofRenderer(hashes_[1].substr(0, 7) + "-dirty", 0.2), "--dirty").code, 0);
    EXPECT_EQ(add(ofRenderer("v9.9", 0.2)).code, 2) << "no such commit";
}

TEST_F(History, AChangeNamesItsCommitsAndHowToNarrowItDown) {
    ASSERT_EQ(add(records(hashes_[3], 0.4)).code, 0); // the order of adding does not matter
    ASSERT_EQ(add(records(hashes_[0], 0.1)).code, 0);
    Outcome outcome = show();
    EXPECT_EQ(outcome.code, 0) << outcome.output; // advice, not a verdict
    EXPECT_NE(outcome.output.find("3 commits between " + hashes_[0].substr(0, 7) + " and " + hashes_[3].substr(0, 7)),
              std::string::npos)
        << outcome.output;

    const auto change = nlohmann::json::parse(show("--format json").output)["changes"][0];
    EXPECT_EQ(change["suspects"], 3);
    const std::string middle = change["middle"];
    EXPECT_TRUE(middle == hashes_[1] || middle == hashes_[2]) << middle;
    EXPECT_NE(change["narrow"].get<std::string>().find("tools/backfill " + middle.substr(0, 7)), std::string::npos);

    ASSERT_EQ(add(records(hashes_[1], 0.1)).code, 0);
    ASSERT_EQ(add(records(hashes_[2], 0.4)).code, 0);
    const auto narrowed = nlohmann::json::parse(show("--format json").output)["changes"][0];
    EXPECT_EQ(narrowed["suspects"], 1);
    EXPECT_EQ(narrowed["after"]["first"], hashes_[2]);
}

TEST_F(History, AncestryOrdersCommitsWhoseDatesDoNot) {
    ASSERT_EQ(git("commit --quiet --allow-empty -m 'a clock that is wrong'", "2025-06-01T12:00:00Z").code, 0);
    std::string wrong = git("rev-parse HEAD").output;
    wrong.pop_back();
    ASSERT_EQ(add(records(hashes_[3], 0.1)).code, 0);
    ASSERT_EQ(add(records(wrong, 0.4)).code, 0);
    const auto json = nlohmann::json::parse(show("--format json").output);
    EXPECT_EQ(json["commits"][1]["commit"], wrong);
    EXPECT_EQ(json["changes"][0]["direction"], "worse");
    EXPECT_EQ(json["commits"][1]["subject"], "a clock that is wrong");
}

TEST_F(History, WithoutARepositoryDatesOrderCommits) {
    ASSERT_EQ(add(records(hashes_[3], 0.4)).code, 0);
    ASSERT_EQ(add(records(hashes_[0], 0.1)).code, 0);
    const Folder elsewhere;
    std::filesystem::copy(folder_ / "history", elsewhere / "history");
    const Outcome outcome = shell("shadowbench history show --format json --from " + (elsewhere / "history"));
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["commits"][0]["commit"], hashes_[0]);
    EXPECT_EQ(json["changes"].size(), 1U);
    EXPECT_FALSE(json["changes"][0].contains("suspects"));
}

TEST_F(History, APageIsWrittenAndBadInputIsRefused) {
    ASSERT_EQ(add(records(hashes_[0], 0.1)).code, 0);
    ASSERT_EQ(add(records(hashes_[1], 0.4)).code, 0);
    const Outcome outcome = show("--out " + (folder_ / "page"));
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "page/report.md"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "page/accuracy.leak-dueling-frusta.svg"));
    EXPECT_EQ(show("--metric accuracy.leek").code, 2);
    EXPECT_EQ(show("--format html").code, 2);
    EXPECT_EQ(shell("shadowbench history show --from " + (folder_ / "nowhere")).code, 2);
}

} // namespace
} // namespace shadowbench
