// Instruction counts and comparisons as a user makes them.
#include "base/files.h"
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class Gate : public ::testing::Test {
protected:
    [[nodiscard]] Outcome run(const std::string& out, const std::string& more) const {
        return shell("shadowbench run --quiet --scene " + scene_ + " --cache " + folder_.cache() + " --out " +
                     (folder_ / out) + " " + more);
    }
    [[nodiscard]] std::vector<Record> records(const std::string& out) const {
        return readRecords(folder_ / (out + "/results.jsonl"));
    }
    [[nodiscard]] Outcome compare(const std::string& base, const std::string& head, const std::string& more = "") const {
        return shell("shadowbench compare " + (folder_ / base) + " " + (folder_ / head) + " " + more);
    }

    Folder folder_;
    std::string scene_ = folder_.write("tiny.toml", tinyScene());
};

// After others in one process a count was 0.8 % off: each variant is counted in a process of its own.
TEST_F(Gate, InstructionCountsAreTheSameInEveryRunWhateverIsCountedBefore) {
    const std::string history = " --technique sm-history", volume = " --technique volume-zfail";
    for (const auto& [out, techniques] : std::vector<std::pair<std::string, std::string>>{
             {"first", history + volume}, {"second", " --technique pcf" + volume + history}}) {
        const Outcome outcome = run(out, "--cost instructions" + techniques);
        ASSERT_EQ(outcome.code, 0) << outcome.output;
    }
    const std::vector<Record> first = records("first"), second = records("second");
    ASSERT_EQ(first.size(), 2U);
    for (const Record& one : first) {
        const auto other = std::ranges::find(second, one.variant, &Record::variant);
        ASSERT_NE(other, second.end()) << one.variant;
        ASSERT_TRUE(one.values["cost.instructions"] && other->values["cost.instructions"]) << one.variant;
        const auto a = *one.values["cost.instructions"], b = *other->values["cost.instructions"];
        EXPECT_NEAR(a / b, 1, 1e-6) << one.variant;
        EXPECT_GT(a, 1e5) << one.variant; // a frame of 48² pixels, not an empty count
        EXPECT_FALSE(one.values["cost.time.median"]);
    }
    EXPECT_EQ(compare("first", "second", "--same-program").code, 5) << "the first has no pcf";
    std::vector<Record> both = second;
    std::erase_if(both, [](const Record& record) { return record.variant == "pcf"; });
    writeRecords(folder_ / "both/results.jsonl", both);
    EXPECT_EQ(compare("first", "both", "--same-program").code, 0);
    const Outcome former = compare("first", "both", "--aa");
    EXPECT_EQ(former.code, 0);
    EXPECT_NE(former.output.find("--aa is now called --same-program"), std::string::npos) << former.output;
}

TEST_F(Gate, LevelsOfDetailAreCountedToo) {
    scene_ = folder_.write("walk.toml", walkScene());
    const Outcome outcome = run("lod", "--cost instructions --technique lod-switch --technique lod-frame-sequential");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::vector<Record> counted = records("lod");
    ASSERT_EQ(counted.size(), 2U);
    ASSERT_TRUE(counted[0].values["cost.instructions"] && counted[1].values["cost.instructions"]);
    // Which of its two levels an instance shows, and so which of the two draws more, is up to the frame.
    EXPECT_NE(*counted[1].values["cost.instructions"], *counted[0].values["cost.instructions"]);
    EXPECT_EQ(compare("lod", "lod", "--same-program").code, 0);
}

TEST_F(Gate, WithoutValgrindAnInstructionCountIsInconclusive) {
    const Outcome outcome = shell("PATH=/nowhere " + std::string(PROGRAM) + " run --quiet --scene " + scene_ + " --cache " +
                                  folder_.cache() + " --out " + (folder_ / "out") + " --technique none --cost instructions");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_NE(outcome.output.find("apt-get install valgrind"), std::string::npos) << outcome.output;
}

TEST_F(Gate, AWorseMapIsAnAccuracyRegressionThatEveryFormNames) {
    ASSERT_EQ(run("base", "--cost none --technique sm-uniform:map=256").code, 0);
    std::vector<Record> worse = records("base");
    ASSERT_EQ(run("head", "--cost none --technique sm-uniform:map=64").code, 0);
    const Record coarse = records("head")[0];
    worse[0].images = coarse.images;
    for (const metrics::Metric& line : metrics::linesOf("accuracy")) worse[0].values[line] = coarse.values[line];
    writeRecords(folder_ / "worse/results.jsonl", worse);
    const Outcome outcome = compare("base", "worse",
                                    "--same-program --annotations --junit " + (folder_ / "junit.xml") + " --summary " +
                                        (folder_ / "summary.md"));
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    EXPECT_NE(outcome.output.find("::error title="), std::string::npos) << outcome.output;
    for (const char* file : {"junit.xml", "summary.md"})
        EXPECT_NE(readFile(folder_ / file).find("accuracy.mismatch"), std::string::npos) << file;
    EXPECT_EQ(compare("base", "base", "--same-program").code, 0);
    const Outcome twice = compare("base", "base");
    EXPECT_EQ(twice.code, 5) << twice.output;
    EXPECT_NE(twice.output.find("records of one program"), std::string::npos) << twice.output;
    std::vector<Record> renamed = records("base");
    renamed[0].scene = "another";
    writeRecords(folder_ / "renamed/results.jsonl", renamed);
    EXPECT_EQ(compare("base", "renamed", "--same-program").code, 5) << "nothing is in both";
    EXPECT_EQ(compare("base", "nowhere").code, 2);
}

} // namespace
} // namespace shadowbench
