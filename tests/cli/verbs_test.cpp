// The verbs as documented: what they print, what they write, what they return.
#include "harness/records/record.h"
#include "harness/runs/merge.h"
#include "techniques/catalog.h"
#include "tests/support/program.h"

#include <algorithm>
#include <csignal>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

/// The words in the first column of a help text's list of subcommands; none where it has no such list.
std::vector<std::string> subcommandsIn(const std::string& help) {
    std::vector<std::string> names;
    std::istringstream lines(help.substr(std::min(help.find("\nSubcommands:\n"), help.size())));
    std::string line;
    std::getline(lines, line); // the rest of the line before
    std::getline(lines, line); // the heading
    while (std::getline(lines, line) && line.starts_with("  "))
        if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2)); // no continuation of the text beside
    return names;
}

/// Every verb that the program's help lists, with the subcommands that the verbs' own help lists: "cache", "cache list" …
/// Each must have an example.
std::vector<std::string> verbsWithHelp(const std::string& verb = "") {
    const Outcome help = shell("shadowbench " + verb + " --help");
    EXPECT_EQ(help.code, 0) << verb;
    if (!verb.empty()) {
        EXPECT_NE(help.output.find("Example"), std::string::npos) << verb;
    }
    std::vector<std::string> verbs;
    for (const std::string& name : subcommandsIn(help.output)) {
        const std::string inner = verb.empty() ? name : verb + " " + name;
        verbs.push_back(inner);
        std::ranges::move(verbsWithHelp(inner), std::back_inserter(verbs));
    }
    return verbs;
}

TEST(CommandLine, HelpOfTheProgramNamesEveryVerbAndEachHasAnExample) {
    const std::vector<std::string> verbs = verbsWithHelp();
    for (const char* verb :
         {"list",        "inspect",      "run",         "merge",       "score",         "reference", "sweep",
          "causes",      "recommend",    "claims",      "export",      "compare",       "gate",      "history",
          "history add", "history show", "develop",     "check",       "new-technique", "report",    "cache",
          "cache list",  "cache verify", "cache prune", "shader-cost", "gpu-cost",      "ci"})
        EXPECT_EQ(std::ranges::count(verbs, verb), 1) << verb;
    EXPECT_EQ(std::ranges::count(verbs, "count-frames"), 0) << "for the program's own use";
}

TEST(CommandLine, OutputThatCannotBeWrittenIsOneLineAndACode) {
    for (const char* words : {"list", "list schema", "policy", "--version", "gate --help"}) {
        const Outcome full = shell(std::string("shadowbench ") + words + " 3>&1 >/dev/full 2>&3 3>&-; exit $? #");
        EXPECT_EQ(full.code, 1) << words;
        EXPECT_EQ(full.output, "shadowbench: cannot write to standard output: No space left on device; free some space or "
                               "choose another place\n")
            << words;
    }
    EXPECT_EQ(shell("shadowbench run --scene nowhere 2>/dev/full; exit $? #").code, 2) << "of what it could not say";
}

TEST(CommandLine, ListNamesEveryTechniqueWithItsParameters) {
    const Outcome json = shell("shadowbench list techniques --format json");
    ASSERT_EQ(json.code, 0);
    const auto all = nlohmann::json::parse(json.output);
    ASSERT_EQ(all.size(), techniques::catalog().size());
    EXPECT_EQ(all[0]["id"], "none");
    const auto uniform = std::find_if(all.begin(), all.end(), [](const auto& entry) { return entry["id"] == "sm-uniform"; });
    ASSERT_NE(uniform, all.end());
    EXPECT_EQ((*uniform)["parameters"][0]["name"], "map");
    EXPECT_TRUE((*uniform)["figures"].empty());
    const auto pass = std::find_if(all.begin(), all.end(), [](const auto& entry) { return entry["id"] == "volume-zpass"; });
    ASSERT_NE(pass, all.end());
    EXPECT_EQ((*pass)["figures"][0]["name"], "volume_triangles");
    EXPECT_NE(shell("shadowbench list techniques").output.find("figures.stencil_bytes: bytes"), std::string::npos);
    EXPECT_TRUE(shell("shadowbench list techniques").output.ends_with("where it breaks: docs/techniques/<id>.md\n"));
    EXPECT_NE(shell("shadowbench list scenes").output.find("dueling-frusta"), std::string::npos);
    EXPECT_NE(shell("shadowbench list metrics --format md").output.find("| mismatch |"), std::string::npos);
}

TEST(CommandLine, ListPrintsIdsOneALine) {
    for (const char* what : {"techniques", "scenes", "metrics", "limits"})
        EXPECT_EQ(shell(std::string("shadowbench list --format ids ") + what).code, 0) << what;
    EXPECT_TRUE(shell("shadowbench list metrics --format ids").output.starts_with("lod.pop\n"));
}

TEST(CommandLine, ListWritesAPageForEachTechnique) {
    const Folder folder;
    const std::string records = folder.write("results.jsonl", "");
    const Outcome written = shell("shadowbench list techniques --pages " + folder / "pages" + " --records " + records);
    ASSERT_EQ(written.code, 0) << written.output;
    for (const techniques::Entry& entry : techniques::catalog())
        EXPECT_TRUE(fs::exists(folder / ("pages/" + entry.id + ".md"))) << entry.id;
    EXPECT_EQ(shell("shadowbench list scenes --pages " + folder / "pages").code, 2);
    EXPECT_EQ(shell("shadowbench list techniques --format json --pages " + folder / "pages").code, 2);
}

class Run : public testing::Test {
protected:
    [[nodiscard]] std::string command(const std::string& options) const {
        return "shadowbench run --quiet --scene " + scene_ + " --out " + folder_ / "out" + " --cache " + cache_ + " " +
               options;
    }
    [[nodiscard]] std::vector<Record> records() const { return readRecords(folder_ / "out/results.jsonl"); }

    Folder folder_;
    std::string cache_ = folder_.cache();
    std::string scene_ = folder_.write("tiny.toml", tinyScene());
};

TEST_F(Run, WritesRecordsPageAndCharts) {
    const Outcome run = shell(command("--technique none --technique sm-uniform --technique volume-zfail --images"));
    ASSERT_EQ(run.code, 0) << run.output;
    EXPECT_NE(run.output.find("volume-zfail"), std::string::npos);
    ASSERT_EQ(records().size(), 3U);
    EXPECT_EQ(records()[2].variant, "volume-zfail");
    EXPECT_EQ(records()[2].status, Status::Scored);
    EXPECT_GT(*records()[0].values["accuracy.mismatch"],
              *records()[1].values["accuracy.mismatch"]); // no shadow is worse than a map
    EXPECT_TRUE(fs::exists(folder_ / "out/report.md"));
    EXPECT_TRUE(fs::exists(folder_ / "out/pareto-tiny.svg"));
    EXPECT_TRUE(fs::exists(folder_ / "out/images/tiny/sm-uniform/error.png"));
    EXPECT_TRUE(fs::exists(folder_ / "out/images/tiny/sm-uniform/visibility.exr"));
}

TEST_F(Run, SoftTechniquesDoNotApplyToAPointLight) {
    ASSERT_EQ(shell(command("--technique pcss")).code, 2) << "nothing else was asked for";
    EXPECT_EQ(records()[0].status, Status::NotApplicable);
    EXPECT_NE(records()[0].reason.find("area light"), std::string::npos);
}

TEST_F(Run, TwiceTheSameGivesTheSameRecordsButForTimes) {
    const auto lines = [&] {
        EXPECT_EQ(shell(command("--cost none --technique sm-history --technique volume-zfail")).code, 0);
        std::vector<std::string> result;
        for (Record record : records()) {
            record.time.clear();
            result.push_back(toJson(record));
        }
        return result;
    };
    const auto first = lines();
    EXPECT_EQ(lines(), first);
}

TEST_F(Run, AResumedRunKeepsWhatIsFinished) {
    ASSERT_EQ(shell(command("--technique sm-uniform")).code, 0);
    const Record before = records()[0];
    ASSERT_EQ(shell(command("--resume --technique sm-uniform --technique none")).code, 0);
    ASSERT_EQ(records().size(), 2U);
    EXPECT_EQ(toJson(records()[0]), toJson(before)); // times and all: it was not run again
}

TEST_F(Run, AResumedRunKeepsNothingOfAnotherProgram) {
    ASSERT_EQ(shell(command("--technique sm-uniform --cost none")).code, 0);
    Record stale = records()[0];
    const std::string program = stale.program;
    EXPECT_EQ(program.size(), 32U);
    stale.program = "another, of the same commit";
    stale.values["accuracy.leak"] = 0.5;
    writeRecords(folder_ / "out/results.jsonl", {stale});
    ASSERT_EQ(shell(command("--resume --technique sm-uniform --cost none")).code, 0);
    EXPECT_EQ(records()[0].program, program);
    EXPECT_LT(*records()[0].values["accuracy.leak"], 0.5);
}

/// Kills the command as soon as the file has that many lines and some time has passed.
Outcome killedAfter(std::size_t lines, const std::string& file, const std::string& seconds, const std::string& command) {
    return shell(command + " & pid=$!; while kill -0 $pid 2>/dev/null && [ \"$(cat " + file +
                 " 2>/dev/null | wc -l)\" -lt " + std::to_string(lines) + " ]; do sleep 0.01; done; sleep " + seconds +
                 "; kill -KILL $pid; wait $pid");
}

/// Expects that what `before` holds of cells is still there: times, too, once they were taken.
void expectKept(const std::vector<Record>& before, const std::vector<Record>& after) {
    for (const Record& record : before) {
        const auto same = std::ranges::find(after, record.variant, &Record::variant);
        ASSERT_NE(same, after.end()) << record.variant << " was lost";
        if (record.values["cost.time.median"])
            EXPECT_EQ(toJson(*same), toJson(record)) << "it was run again";
        else
            EXPECT_EQ(toJson(shards::withoutTimings(*same)), toJson(shards::withoutTimings(record)));
    }
}

TEST_F(Run, KilledAtAnyMomentItLeavesWholeRecordsAndResumes) {
    const std::string all = command("--resume --technique sm-uniform --technique 'sm-h*' --technique pcf");
    const std::string file = folder_ / "out/results.jsonl";
    std::vector<Record> before;
    for (const auto& [lines, seconds] :
         std::vector<std::pair<std::size_t, std::string>>{{0, "0.1"}, {1, "0"}, {2, "0.05"}, {4, "0.02"}}) {
        const Outcome killed = killedAfter(lines, file, seconds, all);
        EXPECT_EQ(killed.code, 128 + SIGKILL) << "the run ended before the kill: " << killed.output;
        if (lines == 0 && !fs::exists(file)) continue;
        const std::vector<Record> whole = records();
        EXPECT_GE(whole.size(), lines);
        expectKept(before, whole);
        before = whole;
    }
    ASSERT_EQ(shell(all).code, 0);
    EXPECT_EQ(records().size(), 7U); // a map, five variants of history, pcf
    expectKept(before, records());
    for (const Record& record : records()) EXPECT_TRUE(record.values["cost.time.median"]) << record.variant;
}

TEST_F(Run, ScoresAreTheSameHoweverManyProcessesShareThem) {
    std::string first;
    for (const std::string jobs : {"1", "2", "5"}) {
        ASSERT_EQ(shell(command("--technique 'sm-*' --technique 'pcf*' --cost none --jobs " + jobs)).code, 0);
        std::string lines;
        for (Record record : records()) lines += toJson(shards::withoutTimings(record)) + "\n";
        if (first.empty()) first = lines;
        EXPECT_EQ(lines, first) << jobs;
    }
}

TEST_F(Run, ADamagedCacheEntryIsReplaced) {
    cache_ = folder_ / "own";
    ASSERT_EQ(shell(command("--technique none")).code, 0);
    const double mismatch = *records()[0].values["accuracy.mismatch"];
    for (const auto& entry : fs::recursive_directory_iterator(cache_))
        if (entry.is_regular_file()) fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
    const Outcome again = shell(command("--technique none"));
    EXPECT_EQ(again.code, 0);
    EXPECT_NE(again.output.find("damaged"), std::string::npos) << again.output;
    EXPECT_EQ(*records()[0].values["accuracy.mismatch"], mismatch);
}

TEST_F(Run, ReportIsMadeAgainFromRecordsAlone) {
    ASSERT_EQ(shell(command("--technique none --technique sm-uniform")).code, 0);
    const Outcome report = shell("shadowbench report " + folder_ / "out/results.jsonl" + " --out " + folder_ / "again");
    ASSERT_EQ(report.code, 0) << report.output;
    const auto text = [](const std::string& file) { return (std::ostringstream() << std::ifstream(file).rdbuf()).str(); };
    const Outcome label =
        shell("shadowbench report " + folder_ / "out/results.jsonl" + " --label nosuch --out " + folder_ / "no");
    EXPECT_EQ(label.code, 2) << label.output;
    EXPECT_NE(label.output.find("--label: no record is of a variant or technique \"nosuch\""), std::string::npos)
        << label.output;
    EXPECT_EQ(text(folder_ / "again/report.md"), text(folder_ / "out/report.md"));
    EXPECT_EQ(text(folder_ / "again/pareto-tiny.svg"), text(folder_ / "out/pareto-tiny.svg"));
}

} // namespace
} // namespace shadowbench
