// What a gate learns of the programs that it compares, and what it makes of their failures.
#include "gate/measured_program.h"

#include "base/error.h"
#include "base/folder_lock.h"
#include "base/parallel.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "tests/gate/programs/stand_in.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

class AMeasuredProgram : public testing::Test {
protected:
    [[nodiscard]] MeasuredProgram measured() const { return {standIn_.program(), folder_.path() / "cache"}; }
    [[nodiscard]] Measured measure(const Step& step) const {
        return measured().measure({step}, [&](double, std::string_view line) { progress_.emplace_back(line); });
    }
    /// What is said of a program that fails.
    [[nodiscard]] std::string complaint() const {
        try {
            (void)measure(step_);
        } catch (const Inconclusive& error) {
            return error.what();
        }
        return "none";
    }

    /// Once it has written a file.
    void isKilled() const {
        standIn_.does("run", findOut_ + "mkdir -p \"$out\"\necho >\"$out/left\"\nkill -9 $$\n");
        EXPECT_NE(complaint().find("signal 9"), std::string::npos);
    }

    const std::string findOut_ = "for word; do\n[ \"${before-}\" != --out ] || out=$word\nbefore=$word\ndone\n";
    TemporaryFolder folder_;
    StandIn standIn_{folder_.path(), "one"};
    mutable std::vector<std::string> progress_;
    Step step_{"tiny", {"run", "--scene", "tiny.toml", "--seed", "1", "--shard", "1/1"}, {"pcf"}, "cells"};
};

TEST_F(AMeasuredProgram, KnowsItsScenesAndEachParametersValues) {
    const MeasuredProgram program = measured();
    EXPECT_TRUE(program.knowsScene("simple"));
    EXPECT_FALSE(program.knowsScene("trees"));
    for (const char* variant : {"pcf", "none", "pcf:map=16", "pcf:map=8192,kernel=5", "pcf:kernel=3"})
        EXPECT_TRUE(program.knowsVariant(variant)) << variant;
    for (const char* variant :
         {"pcss", "pcf:map=15", "pcf:map=8193", "pcf:kernel=4", "pcf:taps=3", "pcf:map=16,kernel=35", "none:map=16", "pc"})
        EXPECT_FALSE(program.knowsVariant(variant)) << variant;
}

TEST_F(AMeasuredProgram, ShowsItsVariantsInItsOrder) {
    standIn_.lists("techniques", R"([{"id": "pcf", "variants": ["", "map=512"], "parameters": []},)"
                                 R"({"id": "esm", "variants": ["map=64"], "parameters": []}])");
    EXPECT_EQ(measured().variants(), (std::vector<std::string>{"pcf", "pcf:map=512", "esm:map=64"}));
}

TEST_F(AMeasuredProgram, SaysWhatItIsIfItIsNewEnough) {
    ASSERT_TRUE(measured().build());
    EXPECT_EQ(measured().build()->program, "one");
    standIn_.does("policy", "echo 'there is no verb policy' >&2; exit 2\n");
    EXPECT_FALSE(measured().build());
}

TEST_F(AMeasuredProgram, IsMeasuredOnce) {
    const Measured first = measure(step_), second = measure(step_);
    ASSERT_EQ(first.records().size(), 1U);
    EXPECT_EQ(first.records()[0].variant, "pcf");
    EXPECT_EQ(first.times.size(), 1U);
    EXPECT_EQ(second.records().size(), 1U);
    EXPECT_TRUE(second.times.empty()) << "it was there";
    EXPECT_EQ(standIn_.calls("run"), 1);
    EXPECT_EQ(progress_, std::vector<std::string>{"tiny 1/3  pcf"}) << "of its lines those that are progress";
}

TEST_F(AMeasuredProgram, IsMeasuredAgainWhereSomebodyChangedOrRemovedItsRecords) {
    const auto kept = [&] {
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / "cache"))
            if (entry.path().extension() == ".jsonl") return entry.path();
        return fs::path();
    };
    (void)measure(step_);
    std::vector<Record> records = readRecords(kept());
    records[0].values["accuracy.leak"] = 0.5;
    writeRecords(kept(), records);
    EXPECT_EQ(measure(step_).records().at(0).values["accuracy.leak"], standInRecord("pcf").values["accuracy.leak"]);
    EXPECT_EQ(standIn_.calls("run"), 2);
    fs::remove(kept());
    EXPECT_EQ(measure(step_).records().size(), 1U);
    EXPECT_EQ(standIn_.calls("run"), 3);
}

TEST_F(AMeasuredProgram, TakesWhatAnotherOfTheSameReachHasMeasured) {
    const StandIn other{folder_.path(), "other"};
    const auto is = [](const StandIn& program, const std::string& commit, const std::string& pcf) {
        program.is({commit, false, commit, {}, Reach("* 1\nfiltered/pcf " + pcf + "\n")});
    };
    is(standIn_, "one", "2");
    is(other, "decaf", "2");
    (void)measure(step_);
    const MeasuredProgram same(other.program(), folder_.path() / "cache");
    EXPECT_TRUE(same.isKept(step_, "pcf"));
    const std::vector<Record> records = same.measure({step_}, [](double, std::string_view) {}).records();
    EXPECT_EQ(other.calls("run"), 0);
    ASSERT_EQ(records.size(), 1U);
    EXPECT_EQ(records[0].commit, "decaf") << "as its own";
    (void)same.measureAgain({step_}, [](double, std::string_view) {});
    EXPECT_EQ(other.calls("run"), 1);

    MeasuredProgram refuted = same;
    refuted.distrustReach();
    EXPECT_FALSE(refuted.isKept(step_, "pcf"));
    is(other, "decaf", "3");
    EXPECT_FALSE(MeasuredProgram(other.program(), folder_.path() / "cache").isKept(step_, "pcf"));
}

TEST_F(AMeasuredProgram, IsMeasuredAgainForOtherInputsAndWithOtherPrograms) {
    (void)measure(step_);
    step_.inputs = "another scene";
    (void)measure(step_);
    EXPECT_EQ(standIn_.calls("run"), 2);
}

/// Its instructions may be counted there, and are not here.
TEST_F(AMeasuredProgram, IsMeasuredAgainWhereThereIsNoValgrind) {
    (void)measure(step_);
    const fs::path tools = folder_.path() / "tools";
    fs::create_directories(tools);
    for (const char* tool : {"basename", "cat", "dirname", "grep", "mkdir"})
        if (const auto found = findProgram(tool)) fs::create_symlink(*found, tools / tool);
    const std::string before = std::getenv("PATH");
    setenv("PATH", tools.c_str(), 1);
    const Measured without = measure(step_);
    setenv("PATH", before.c_str(), 1);
    EXPECT_EQ(without.records().size(), 1U);
    EXPECT_EQ(standIn_.calls("run"), findProgram("valgrind") ? 2 : 1);
}

TEST_F(AMeasuredProgram, SaysHowFarItIsInLinesOfTheirOwnForm) {
    standIn_.does("run", "for line in 'a 1/2 x' '/2' 'x/2' '1/x' '1/' ' 1/2' 'no slash' ''; do echo \"$line\"; done\n");
    (void)measure(step_);
    EXPECT_EQ(progress_, (std::vector<std::string>{"a 1/2 x", "tiny 1/3  pcf"}));
}

TEST_F(AMeasuredProgram, ThatAnotherGateMeasuresIsWaitedFor) {
    isKilled();
    standIn_.does("run", "");
    std::optional<FolderLock> other;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "cache/gate"))
        if (entry.path().filename() != "results") other.emplace(entry.path());
    const Measured waited = measured().measure({step_}, [&](double, std::string_view line) {
        progress_.emplace_back(line);
        other.reset();
    });
    EXPECT_EQ(waited.records().size(), 1U);
    EXPECT_EQ(std::ranges::count(progress_, "waiting for another gate that measures this program"), 1);
}

TEST_F(AMeasuredProgram, IsTriedAgainWhereACellFailed) {
    Record failed = standInRecord("none");
    failed.status = Status::Error;
    failed.reason = "the driver was lost";
    standIn_.measures({standInRecord("pcf"), failed});
    step_.techniques.emplace_back("none");
    EXPECT_EQ(measure(step_).records().size(), 2U);
    EXPECT_TRUE(measured().isKept(step_, "pcf"));
    EXPECT_FALSE(measured().isKept(step_, "none"));
    EXPECT_EQ(measure(step_).records().size(), 2U);
    EXPECT_EQ(standIn_.calls("run"), 2);
}

TEST_F(AMeasuredProgram, GoesOnWhereItWasKilled) {
    isKilled();
    standIn_.does("run", findOut_ + "[ -e \"$out/left\" ] || exit 1\n");
    EXPECT_EQ(measure(step_).records().size(), 1U);
}

/// Of a run alone, which otherwise takes one process and makes pages.
TEST_F(AMeasuredProgram, RunsAPartWithAllProcessors) {
    for (const char* verb : {"run", "sweep"}) standIn_.does(verb, "echo \"$*\" >\"$here/words\"\n");
    const auto words = [&] { return readFile(standIn_.program().parent_path() / "words"); };
    (void)measure(step_);
    EXPECT_NE(words().find(fmt::format(" --shard 1/1 --jobs {} ", availableThreads())), std::string::npos) << words();
    Record swept = standInRecord("pcf");
    swept.sweep = SweepStep{"near-plane", "m", "pcf", 1, 0.1};
    standIn_.measures({swept});
    const Step sweep{"tiny", {"sweep", "--scene", "tiny.toml", "--seed", "1"}, {"pcf"}, "sweep.jsonl"};
    EXPECT_TRUE(measure(sweep).records().at(0).sweep);
    EXPECT_EQ(words().find(" --jobs"), std::string::npos) << words();
}

TEST_F(AMeasuredProgram, WithACellThatIsWorthARetryIsInconclusive) {
    standIn_.endsWith(75);
    EXPECT_NE(complaint().find("one/shadowbench failed at tiny"), std::string::npos) << complaint();
}

TEST_F(AMeasuredProgram, ThatFailsIsNamedWithItsLastLine) {
    standIn_.does("run", "echo first >&2; echo; echo 'no disk' >&2; exit 1\n");
    EXPECT_NE(complaint().find("one/shadowbench failed at tiny: no disk"), std::string::npos) << complaint();
    standIn_.does("run", "kill -9 $$\n");
    EXPECT_NE(complaint().find("it was ended by signal 9"), std::string::npos) << complaint();
}

TEST_F(AMeasuredProgram, ThatIsNoneIsInconclusive) {
    EXPECT_THROW(MeasuredProgram(folder_.path() / "nowhere", folder_.path()), Inconclusive);
    standIn_.lists("scenes", "no JSON");
    EXPECT_NE(complaint().find("does not say which scenes it has: no JSON"), std::string::npos) << complaint();
    standIn_.lists("scenes", "{}");
    EXPECT_NE(complaint().find("does not say which scenes"), std::string::npos);
    standIn_.lists("scenes", "[]");
    standIn_.does("list", "echo '[]'; exit 1\n");
    EXPECT_NE(complaint().find("does not say which scenes"), std::string::npos) << "its exit code says otherwise";
}

} // namespace
} // namespace shadowbench::gate
