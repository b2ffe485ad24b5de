// The gate as a user runs it: what is a base, what its verdicts are, and what becomes of it when it is killed.
#include "base/files.h"
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class GateVerb : public ::testing::Test {
protected:
    /// `--bounds` is empty unless `more` names another.
    [[nodiscard]] std::string command(const std::string& base, const std::string& more) const {
        std::string words = "shadowbench gate --quiet --scene " + scene_ + " --cache " + cache_ + " --out " +
                            (folder_ / "out") + " --bounds " + bounds_ + " " + more;
        return base.empty() ? words : words + " --base " + base;
    }
    [[nodiscard]] Outcome gate(const std::string& base, const std::string& more) const { return shell(command(base, more)); }

    /// Records of a run, as a base.
    [[nodiscard]] std::string recorded(const std::string& techniques) const {
        const Outcome outcome = shell("shadowbench run --quiet --cost none --scene " + scene_ + " --cache " + cache_ +
                                      " --out " + (folder_ / "base") + " " + techniques);
        EXPECT_EQ(outcome.code, 0) << outcome.output;
        return folder_ / "base/results.jsonl";
    }

    Folder folder_;
    std::string cache_ = folder_.cache();
    std::string scene_ = folder_.write("tiny.toml", tinyScene());
    std::string bounds_ = folder_.write("bounds.toml", "");
};

TEST_F(GateVerb, TheSameProgramPasses) {
    const Outcome outcome = gate(PROGRAM, "--same-program --cost instructions --technique sm-uniform");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("0 worse, 0 better"), std::string::npos) << outcome.output;
    EXPECT_NE(readFile(folder_ / "out/gate.html").find("Nothing is worse"), std::string::npos);
}

TEST_F(GateVerb, ShadersOfTheSameProgramAreTheSame) {
    const Outcome outcome = gate(PROGRAM, "--same-program --cost shader --technique sm-uniform --annotations");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    const bool isCompared = outcome.output.find("shaders are not compared") == std::string::npos; // else without the driver
    for (const char* side : {"base", "head"})
        EXPECT_EQ(fs::exists(folder_ / "out/shader-cost/" + side + "/shader-cost.jsonl"), isCompared) << side;
    EXPECT_EQ(readFile(folder_ / "out/gate.html").find("<th scope=\"row\" class=\"\">shader<") != std::string::npos,
              isCompared);
}

/// This program, saying something else of itself.
class SaidOtherwise {
public:
    explicit SaidOtherwise(const Folder& folder) : folder_(folder) {
        identity = nlohmann::ordered_json::parse(shell("shadowbench policy").output);
    }

    [[nodiscard]] std::string program() const {
        const std::string said = folder_.write("identity.json", identity.dump(1));
        std::string file = folder_.write("base-program", "#!/bin/sh\ncase $1 in policy) cat " + said + " ;; " + answers +
                                                             " *) exec " PROGRAM " \"$@\" ;; esac\n");
        fs::permissions(file, fs::perms::owner_exec, fs::perm_options::add);
        return file;
    }

    nlohmann::ordered_json identity;
    std::string answers; // to other verbs, as branches of a shell's `case`

private:
    const Folder& folder_;
};

TEST_F(GateVerb, TheSameCommitTwiceDecidesNothing) {
    const Outcome outcome = gate(PROGRAM, "--technique sm-uniform --cost none");
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    EXPECT_NE(outcome.output.find("base and head are one program"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("--same-program"), std::string::npos) << outcome.output;
}

TEST_F(GateVerb, CommitsThatMakeTheSameProgramPassAndTheGateSaysSo) {
    SaidOtherwise base(folder_);
    base.identity["commit"] = "decafdecafdecaf";
    bounds_ = std::string(SOURCE_FOLDER) + "/gate/bounds.toml";
    const Outcome outcome = gate(base.program(), "--technique sm-uniform --cost none");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("make the same program"), std::string::npos) << outcome.output;
}

TEST_F(GateVerb, TheBasesStricterPolicyJudgesAndEveryLooseningIsListed) {
    SaidOtherwise base(folder_);
    base.identity["commit"] = "decafdecafdecaf";
    base.identity["program"] = "another";
    base.identity["policy"]["bound"] = {{{"scene", "tiny"},
                                         {"techniques", {"none"}},
                                         {"except", nlohmann::json::array()},
                                         {"reason", "test"},
                                         {"metric", "leak"},
                                         {"value", 0.5},
                                         {"below", true}}};
    const Outcome outcome = gate(base.program(), "--technique none --cost none");
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    EXPECT_NE(outcome.output.find("must be below 0.5: test"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("none on tiny: leak below 0.5 is gone or looser here"), std::string::npos)
        << outcome.output;
}

TEST_F(GateVerb, AHeadThatTakesLongerThanItsBaseIsACostRegression) {
    SaidOtherwise base(folder_);
    base.identity["commit"] = "decafdecafdecaf";
    base.identity["program"] = "another";
    base.identity.erase("reach"); // what it can differ in is not known
    base.answers = "time-frames) while read count variant; do printf '0.%05d 1\\n' $count; done ;;"; // next to nothing
    const Outcome outcome = gate(base.program(), "--technique none --cost time");
    EXPECT_EQ(outcome.code, 3) << outcome.output;
    EXPECT_NE(outcome.output.find("worse        time          none on tiny: a frame takes "), std::string::npos)
        << outcome.output;
    EXPECT_NE(outcome.output.find("--cost time --scene " + scene_ + " --technique none"), std::string::npos)
        << outcome.output;
    const Outcome untimed = gate(base.program(), "--technique lod-switch --cost time");
    EXPECT_NE(untimed.output.find("time is not compared: none of the chosen cells is timed"), std::string::npos)
        << untimed.output;
}

TEST_F(GateVerb, ASelectionThatAppliesNowhereIsInconclusive) {
    const Outcome outcome = gate(PROGRAM, "--same-program --technique pcss --cost none"); // the scene has a point light
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    EXPECT_NE(outcome.output.find("no cell is scored in both"), std::string::npos) << outcome.output;
}

TEST_F(GateVerb, AWorseHeadFailsWithPicturesAndACommandThatShowsItAgain) {
    const std::string base = recorded("--technique sm-uniform:map=64");
    std::vector<Record> records = readRecords(base);
    records[0].values["accuracy.leak"] = *records[0].values["accuracy.leak"] - 0.05; // the base was better …
    records[0].images = "others";                                                    // … and drew something else
    writeRecords(base, records);
    const Outcome outcome = gate(base, "--same-program --technique sm-uniform:map=64 --cost none --annotations --junit " +
                                           (folder_ / "junit.xml") + " --summary " + (folder_ / "summary.md"));
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    EXPECT_NE(outcome.output.find("worse        leak"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("--technique sm-uniform:map=64 --profile gate --seed 1"), std::string::npos);
    EXPECT_NE(outcome.output.find("::error title=leak is worse"), std::string::npos) << outcome.output;
    for (const char* picture : {"visibility.png", "reference.png", "error.png"})
        EXPECT_TRUE(fs::exists(folder_ / "out/pictures/head/images/tiny/sm-uniform_map=64" / fs::path(picture))) << picture;
    const std::string page = readFile(folder_ / "out/gate.html");
    EXPECT_NE(page.find("href=\"cells/tiny.html#head_sm-uniform_map=64\""), std::string::npos) << page;
    EXPECT_TRUE(fs::exists(folder_ / "out/cells/tiny/head_sm-uniform_map=64.js"));
    for (const char* file : {"junit.xml", "summary.md"})
        EXPECT_NE(readFile(folder_ / file).find("accuracy.leak"), std::string::npos) << file;
    EXPECT_EQ(readRecords(folder_ / "out/results.jsonl").size(), 1U) << "for later gates";
}

TEST_F(GateVerb, BoundsAndExpectedFailuresAreJudgedWhateverTheBaseIs) {
    const std::string bound = "[[bound]]\nscene = \"tiny\"\ntechniques = [\"none\"]\nmetric = \"leak\"\nreason = \"test\"\n";
    folder_.write("kept.toml", bound + "above = 0.9\n");
    folder_.write("broken.toml", bound + "below = 0.5\n");
    const std::string base = recorded("--technique none");
    const std::string more = "--technique none --cost none --bounds ";
    EXPECT_EQ(shell("shadowbench gate --quiet --scene " + scene_ + " --cache " + cache_ + " --out " + (folder_ / "out") +
                    " --same-program --base " + base + " " + more + (folder_ / "kept.toml"))
                  .code,
              0);
    const Outcome broken =
        shell("shadowbench gate --quiet --scene " + scene_ + " --cache " + cache_ + " --out " + (folder_ / "out") +
              " --same-program --base " + base + " " + more + (folder_ / "broken.toml"));
    EXPECT_EQ(broken.code, 4) << broken.output;
    EXPECT_NE(broken.output.find("must be below 0.5: test"), std::string::npos) << broken.output;
}

TEST_F(GateVerb, WithoutABaseAToolOrATruthItIsInconclusive) {
    cache_ = folder_ / "empty";
    for (const char* base : {"", "no-such-thing"}) {
        const Outcome outcome = gate(base, "--technique none --cost none");
        EXPECT_EQ(outcome.code, 5) << outcome.output;
        EXPECT_NE(outcome.output.find("--base"), std::string::npos) << outcome.output;
    }
    const Outcome valgrind = shell("PATH=/nowhere " + command(PROGRAM, "--technique none --cost instructions"));
    EXPECT_EQ(valgrind.code, 5) << valgrind.output;
    EXPECT_NE(valgrind.output.find("apt-get install valgrind"), std::string::npos) << valgrind.output;
    folder_.write("tiny.toml",
                  tinyScene("{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [0.5, 0, 0], v = [0, 0, 0.5] }"));
    const Outcome povray = shell("PATH=/nowhere " + command(PROGRAM, "--same-program --technique pcss --cost none"));
    EXPECT_EQ(povray.code, 5) << povray.output;
    EXPECT_NE(povray.output.find("povray"), std::string::npos) << povray.output;
    const Outcome bounds = gate(PROGRAM, "--technique none --cost none --bounds /nowhere/bounds.toml");
    EXPECT_NE(bounds.code, 0) << bounds.output;
}

TEST_F(GateVerb, RecordsWithoutTheCellsAreNoBase) {
    const Outcome outcome = gate(recorded("--technique none"), "--technique sm-uniform --cost time,instructions");
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    for (const char* sentence : {"no cell is scored in both", "time is not compared: the base is a file of records",
                                 "instructions are not compared: the base's records hold none"})
        EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
}

TEST_F(GateVerb, ARevisionIsBuiltOnceAndKept) {
    fs::create_directory(folder_ / "repository");
    folder_.write("repository/CMakeLists.txt", "cmake_minimum_required(VERSION 3.25)\nproject(stand_in NONE)\n"
                                               "add_custom_target(shadowbench COMMAND ${CMAKE_COMMAND} -E copy " PROGRAM
                                               " ${CMAKE_BINARY_DIR}/shadowbench)\n");
    const std::string inside = "cd " + (folder_ / "repository") + " && ";
    ASSERT_EQ(shell(inside + "git init -q . && git add . && git -c user.name=a -c user.email=a@b commit -q -m first && "
                             "git tag v1")
                  .code,
              0);
    const std::string more = "--same-program --technique sm-uniform --cost none";
    const Outcome first = shell(inside + command("v1", more));
    EXPECT_EQ(first.code, 0) << first.output;
    EXPECT_NE(first.output.find("base v1 ("), std::string::npos) << first.output;
    ASSERT_EQ(shell(inside + "echo 'message(FATAL_ERROR \"no\")' >> CMakeLists.txt && git -c user.name=a -c user.email=a@b "
                             "commit -q -a -m second")
                  .code,
              0);
    EXPECT_EQ(shell(inside + command("v1", more)).code, 0);
    const Outcome failing = shell(inside + command("HEAD", more));
    EXPECT_EQ(failing.code, 5) << failing.output;
    EXPECT_NE(failing.output.find("building the base, commit "), std::string::npos) << failing.output;
}

/// Shares of a gate's duration; SHADOWBENCH_KILLS asks for more.
std::vector<double> killMoments() {
    const char* wanted = std::getenv("SHADOWBENCH_KILLS");
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.05, 0.95);
    std::vector<double> moments(wanted != nullptr ? std::stoul(wanted) : 3);
    std::ranges::generate(moments, [&] { return share(random); });
    return moments;
}

TEST_F(GateVerb, KilledAtAnyMomentItLeavesNothingPartialAndGoesOn) {
    const std::string more =
        std::string("--same-program --technique sm-uniform --technique pcf --technique volume-zfail --cost ") +
        (std::getenv("SHADOWBENCH_KILLS") != nullptr ? "instructions" : "none"); // a minute a kill
    const auto start = std::chrono::steady_clock::now();
    const Outcome whole = gate(PROGRAM, more);
    ASSERT_EQ(whole.code, 0) << whole.output;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    int unfinished = 0;
    for (const double moment : killMoments()) {
        fs::remove_all(folder_ / "cache/gate");
        fs::remove_all(folder_ / "out");
        const Outcome killed = shell("timeout -s KILL " + std::to_string(moment * seconds) + " " + command(PROGRAM, more));
        if (killed.code != 0) ++unfinished;
        for (const auto& file : fs::recursive_directory_iterator(folder_ / "cache")) {
            if (file.path().filename() != "results.jsonl") continue;
            EXPECT_NO_THROW(readRecords(file.path())) << file.path();
        }
        // The page is whole or not there. A kill may come after it, before the program ends.
        const fs::path page = folder_ / "out/gate.html";
        const std::string said = fs::exists(page) ? readFile(page) : "";
        EXPECT_TRUE(said.find("Nothing is worse") != std::string::npos || (said.empty() && killed.code != 0)) << said;
        const Outcome resumed = gate(PROGRAM, more);
        EXPECT_EQ(resumed.code, 0) << resumed.output;
        EXPECT_EQ(resumed.output.substr(0, resumed.output.find("the same")),
                  whole.output.substr(0, whole.output.find("the same")));
    }
    EXPECT_GT(unfinished, 0) << "no kill came in time";
}

} // namespace
} // namespace shadowbench
