// `ci` in a repository that is not ours, as its owner runs it: a script that copies images is the engine.
#include "base/files.h"
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t lines(const std::string& file) {
    const std::string text = fs::exists(file) ? readFile(file) : "";
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

class Ci : public testing::Test {
protected:
    /// Images that the engine copies, once.
    static void SetUpTestSuite() {
        shared_ = std::make_unique<Folder>();
        const std::string scene = shared_->write("tiny.toml", tinyScene());
        const Outcome own = shell("shadowbench run --quiet --cost none --images --technique pcf --technique pcf:map=64 "
                                  "--scene " +
                                  scene + " --cache " + shared_->cache() + " --out " + (*shared_ / "own"));
        ASSERT_EQ(own.code, 0) << own.output;
    }
    static void TearDownTestSuite() { shared_.reset(); }

    /// A repository whose branch main has one commit: an engine that draws as `pcf`.
    void SetUp() override {
        fs::create_directories(repository_ + "/shadows");
        write("shadows/tiny.toml", tinyScene());
        write("shadows/engine.toml",
              "[[renderer]]\nid = \"engine\"\ncommand = [\"sh\", \"render.sh\", \"{frames}\", \"{out}\", \"{scene}\"]\n");
        write("shadows/render.sh", renders("pcf"));
        write("shadowbench.toml", config(""));
        ASSERT_EQ(git("init -q -b main && git add -A && git commit -q -m first && git checkout -q -b work").code, 0);
    }

    /// A script that counts its calls and copies what we drew.
    [[nodiscard]] std::string renders(const std::string& what, const std::string& before = "") const {
        return fmt::format("set -e\necho call >> {}\n{}cp {}/own/images/tiny/{}/frame-*.exr $2\n", folder_ / "calls", before,
                           *shared_ / "", what);
    }
    [[nodiscard]] static std::string config(const std::string& more) {
        return "renderers = [\"shadows/engine.toml\"]\nscenes = [\"shadows/tiny.toml\"]\n" + more;
    }
    void write(const std::string& file, const std::string& text) const { folder_.write("repository/" + file, text); }
    Outcome git(const std::string& words) const {
        return shell("cd " + repository_ +
                     " && export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b "
                     "GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b; git " +
                     words);
    }
    void commit(const std::string& what) const { ASSERT_EQ(git("commit -q -a -m '" + what + "'").code, 0); }
    [[nodiscard]] std::string command(const std::string& more) const {
        return "cd " + repository_ + " && unset GITHUB_BASE_REF CI_MERGE_REQUEST_DIFF_BASE_SHA; " + more +
               " shadowbench ci --quiet --cache " + folder_.cache() + " --out " + (folder_ / "out");
    }
    [[nodiscard]] Outcome ci(const std::string& options = "", const std::string& before = "") const {
        return shell(command(before) + " " + options);
    }
    [[nodiscard]] std::string page() const { return readFile(folder_ / "out/gate.html"); }
    [[nodiscard]] std::size_t calls() const { return lines(folder_ / "calls"); }
    void expectNoWorktree() const {
        EXPECT_EQ(git("worktree list").output.find('\n'), git("worktree list").output.size() - 1);
        EXPECT_FALSE(contains(shell("find " + (folder_ / "cache/ci")).output, "/worktree"));
    }

    static std::unique_ptr<Folder> shared_;
    Folder folder_;
    std::string repository_ = folder_ / "repository";
};

std::unique_ptr<Folder> Ci::shared_;

TEST_F(Ci, ACommentIsGreenAndASecondRunCallsNobody) {
    write("shadows/render.sh", renders("pcf") + "# a comment\n");
    commit("a comment");
    const Outcome first = ci();
    EXPECT_EQ(first.code, 0) << first.output;
    EXPECT_TRUE(contains(first.output, "gate: pass (head ") && contains(first.output, "base main (")) << first.output;
    EXPECT_EQ(calls(), 2U);
    const Outcome second = ci();
    EXPECT_EQ(second.code, 0) << second.output;
    EXPECT_EQ(calls(), 2U) << "a second run calls nobody";
    ASSERT_EQ(git("commit -q --allow-empty -m 'the same files'").code, 0);
    EXPECT_EQ(ci().code, 0);
    EXPECT_EQ(calls(), 2U) << "other commits of the same files need no call";
    expectNoWorktree();
}

TEST_F(Ci, WhatWasUsedLastIsKeptAndTheOldestGoes) {
    write("shadows/render.sh", renders("pcf") + "# a comment\n");
    commit("a comment");
    ASSERT_EQ(ci().code, 0);
    const std::string kept = "cd " + (folder_ / "cache/ci") + "/*; ";
    ASSERT_EQ(shell(kept + "for i in $(seq 10 29); do mkdir old-$i; touch -d 2020-01-$i old-$i; done").code, 0);
    EXPECT_EQ(ci().code, 0);
    EXPECT_EQ(calls(), 2U);
    const std::string left = shell(kept + "ls").output;
    EXPECT_EQ(std::ranges::count(left, '\n'), 16) << left;
    EXPECT_TRUE(contains(left, "old-16") && !contains(left, "old-15")) << left;
}

TEST_F(Ci, AWorseImageIsRedWithItsFigureAndPicturesOfBothSides) {
    write("shadows/render.sh", renders("pcf_map=64"));
    commit("coarser");
    const Outcome outcome = ci("--annotations --junit j.xml --summary s.md --sarif s.sarif");
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    for (const char* part :
         {"external:engine on tiny: accuracy.", "::error title=", "shadowbench run --images --cost none",
          "--scene shadows/tiny.toml --technique external:engine --profile gate --seed 1 --external shadows/engine.toml"})
        EXPECT_TRUE(contains(outcome.output, part)) << part << "\n" << outcome.output;
    for (const char* side : {"head", "base"})
        for (const char* picture : {"visibility.png", "reference.png", "error.png"})
            EXPECT_TRUE(fs::exists(folder_ / fmt::format("out/pictures/{}/images/tiny/external_engine/{}", side, picture)));
    for (const char* caption : {">head<", ">base<", ">truth<", ">head: orange too dark, blue too bright<"})
        EXPECT_TRUE(contains(page(), caption)) << caption;
    const std::string comment = readFile(repository_ + "/s.md");
    EXPECT_TRUE(contains(comment, "* worse: external:engine on tiny")) << comment;
    EXPECT_LE(std::ranges::count(comment, '\n'), 40);
    EXPECT_TRUE(contains(readFile(repository_ + "/j.xml"), "<failure message="));
}

TEST_F(Ci, SarifNamesEachWorseCellAtItsRenderer) {
    write("shadows/engine.toml", "# moved down by a line\n" + readFile(repository_ + "/shadows/engine.toml"));
    write("shadows/render.sh", renders("pcf_map=64"));
    commit("coarser");
    ASSERT_EQ(ci("--sarif s.sarif").code, 4);
    const auto log = nlohmann::json::parse(readFile(repository_ + "/s.sarif"));
    EXPECT_EQ(log["version"], "2.1.0");
    EXPECT_TRUE(contains(log["$schema"], "sarif-2.1.0"));
    const auto& run = log["runs"].at(0);
    EXPECT_EQ(run["tool"]["driver"]["name"], "shadowbench");
    EXPECT_EQ(run["invocations"].at(0)["executionSuccessful"], true);
    ASSERT_EQ(run["results"].size(), 1U);
    const auto& result = run["results"].at(0);
    EXPECT_EQ(result["level"], "error");
    EXPECT_TRUE(contains(result["message"]["text"], "external:engine on tiny: "));
    const auto& rules = run["tool"]["driver"]["rules"];
    EXPECT_TRUE(std::ranges::any_of(rules, [&](const auto& rule) { return rule["id"] == result["ruleId"]; }));
    const auto& at = result["locations"].at(0)["physicalLocation"];
    EXPECT_EQ(at["artifactLocation"]["uri"], "shadows/engine.toml");
    EXPECT_EQ(at["region"]["startLine"], 2);
}

TEST_F(Ci, ACrashIsInconclusiveAndSaysItsLastLines) {
    write("shadows/render.sh", renders("pcf", "for i in $(seq 30); do echo line $i of it; done\nexit 3\n"));
    commit("crashes");
    const Outcome outcome = ci("--summary s.md");
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    const std::string comment = readFile(repository_ + "/s.md");
    for (const std::string& text : {outcome.output, page(), comment}) {
        EXPECT_TRUE(contains(text, "ended with exit code 3")) << text;
        EXPECT_TRUE(contains(text, "line 11 of it") && contains(text, "line 30 of it")) << text;
        EXPECT_FALSE(contains(text, "line 10 of it")) << text;
    }
    EXPECT_LE(std::ranges::count(comment, '\n'), 40);
    EXPECT_EQ(lines(folder_ / "out/logs/head/tiny/external_engine.txt"), 30U);
    EXPECT_EQ(calls(), 2U);
    EXPECT_EQ(ci().code, 5);
    EXPECT_EQ(calls(), 3U) << "what failed is tried again, and nothing else";
}

TEST_F(Ci, ABuildIsRunInEachTreeAndOneThatFailsIsInconclusive) {
    write("shadowbench.toml", config("build = \"echo built >> " + (folder_ / "builds") + " && cat engine.c\"\n"));
    write("engine.c", "int main;\n");
    ASSERT_EQ(git("add -A").code, 0);
    commit("builds");
    ASSERT_EQ(git("rm -q engine.c").code, 0);
    commit("does not build");
    const Outcome outcome = ci("--base HEAD~1 --sarif s.sarif");
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    EXPECT_EQ(lines(folder_ / "builds"), 2U);
    EXPECT_TRUE(contains(outcome.output, "its build ended with exit code 1")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "cat: engine.c: No such file")) << outcome.output;
    EXPECT_TRUE(contains(page(), "cat: engine.c: No such file"));
    EXPECT_EQ(lines(folder_ / "out/logs/head/build.txt"), 1U);
    const auto log = nlohmann::json::parse(readFile(repository_ + "/s.sarif"));
    EXPECT_TRUE(contains(log["runs"][0]["invocations"][0]["toolExecutionNotifications"].at(0)["message"]["text"],
                         "its build ended with exit code 1"));
    expectNoWorktree();
}

TEST_F(Ci, KilledInTheMiddleItGoesOnAndLeavesNoWorktree) {
    const std::string hangs = "[ -e " + (folder_ / "go") + " ] || { touch " + (folder_ / "hangs") + "; sleep 60; }\n";
    write("shadows/engine.toml", readFile(repository_ + "/shadows/engine.toml") +
                                     "[[renderer]]\nid = \"second\"\ncommand = '''sh second.sh {out} {out} # {scene}'''\n");
    write("shadows/second.sh", hangs + renders("pcf"));
    ASSERT_EQ(git("add -A").code, 0);
    commit("a second one, which hangs");
    const Outcome killed = shell("(" + command("exec env SHADOWBENCH_THREADS=1") + ") & ci=$!; while [ ! -e " +
                                 (folder_ / "hangs") + " ]; do sleep 0.05; done; kill -KILL $ci; wait $ci");
    EXPECT_EQ(killed.code, 128 + 9) << killed.output;
    EXPECT_TRUE(contains(git("worktree list").output, "/worktree")) << "nothing was left: the test kills too late";
    EXPECT_EQ(calls(), 1U);
    folder_.write("go", "");
    const Outcome outcome = ci();
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "new: external:second on tiny")) << outcome.output;
    EXPECT_EQ(calls(), 3U) << "the finished cell was kept";
    expectNoWorktree();
}

TEST_F(Ci, ChangesThatAreInNoCommitAreNotJudgedAndThatIsSaid) {
    write("shadows/render.sh", renders("pcf") + "# a comment\n");
    commit("a comment");
    EXPECT_FALSE(contains(ci().output, "the working tree has changes"));
    write("shadows/render.sh", "exit 1\n");
    const Outcome outcome = ci();
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "the working tree has changes that are in no commit")) << outcome.output;
}

TEST_F(Ci, TheRendererSeesWhatItsUserHas) {
    write("shadows/render.sh", renders("pcf", "echo $(ulimit -n) $(ulimit -v) $HOME $MINE > " + (folder_ / "seen") + "\n"));
    commit("looks about");
    const Outcome outcome = ci("", "ulimit -n 777; export HOME=/somewhere MINE=mine;");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    const std::string memory = shell("echo -n $(ulimit -v)").output;
    EXPECT_EQ(readFile(folder_ / "seen"), "777 " + memory + " /somewhere mine\n");
}

TEST_F(Ci, WrongKeysAndValuesAreOneLineWithTheirPlace) {
    const auto says = [&](const std::string& text, const std::string& sentence) {
        write("shadowbench.toml", text);
        commit("wrong");
        const Outcome outcome = ci();
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        EXPECT_TRUE(contains(outcome.output, sentence)) << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    };
    says("renderer = []\n", "shadowbench.toml:1: renderer: ");
    says("renderers = [\"shadows/engin.toml\"]\n", "shadowbench.toml:1: renderers[1]: the commit has no file");
    says(config("profile = \"fast\"\n"), "shadowbench.toml:3: profile: ");
    says(config("technique = [\"pcf\"]\n"), "shadowbench.toml:3: technique[1]: \"pcf\" is no row of a renderer");
    says(
        config("[[bound]]\nscene = \"tiny\"\ntechniques = [\"external:*\"]\nmetric = \"leek\"\nbelow = 1\nreason = \"r\"\n"),
        "shadowbench.toml:6: bound[1].metric: ");
    says("renderers = [\"shadows/engine.toml\"]\nscenes = [\"windmils\"]\n", "did you mean \"windmills\"?");
    EXPECT_EQ(calls(), 0U);
    expectNoWorktree();
}

TEST_F(Ci, BoundsAndWaiversOfBothCommitsJudge) {
    const std::string bound = "[[bound]]\nscene = \"tiny\"\ntechniques = [\"external:*\"]\nmetric = \"mismatch\"\n"
                              "below = 0.000001\nreason = \"no error at all\"\n";
    const std::string waiver = "[[waiver]]\nscene = \"tiny\"\ntechniques = [\"external:engine\"]\nclass = \"CLASS\"\n"
                               "reason = \"on purpose\"\nexpires = \"2999-12-31\"\n";
    write("shadowbench.toml", config(bound));
    commit("a bound");
    write("shadowbench.toml", config("") + "# no bound\n");
    commit("no bound");
    const Outcome broken = ci("--base HEAD~1");
    EXPECT_EQ(broken.code, 4) << broken.output;
    EXPECT_TRUE(contains(broken.output, "must be below 1e-06: no error at all")) << broken.output;
    EXPECT_TRUE(contains(broken.output, "is gone or looser here")) << broken.output;
    std::string all;
    for (const char* name : {"edge", "leak", "false shadow", "flicker", "labels", "penumbra"}) {
        std::string one = waiver;
        all += one.replace(one.find("CLASS"), 5, name);
    }
    write("shadowbench.toml", config(all));
    write("shadows/render.sh", renders("pcf_map=64"));
    commit("coarser, on purpose");
    const Outcome waived = ci("--base HEAD~1");
    EXPECT_EQ(waived.code, 0) << waived.output;
    EXPECT_TRUE(contains(waived.output, "(accepted until 2999-12-31: on purpose)")) << waived.output;
    EXPECT_TRUE(contains(waived.output, "this build accepts, and its base does not")) << waived.output;
}

TEST_F(Ci, TheBaseIsWhatTheHostSaysElseWhereTheBranchBegan) {
    write("shadows/render.sh", renders("pcf") + "# a comment\n");
    commit("a comment");
    const std::string first = git("rev-parse --short=12 main").output.substr(0, 12);
    ASSERT_EQ(git("update-ref refs/remotes/origin/stable main").code, 0);
    EXPECT_TRUE(contains(ci("", "GITHUB_BASE_REF=stable").output, "base origin/stable (" + first + ")"));
    const std::string whole = git("rev-parse main").output.substr(0, 40);
    EXPECT_TRUE(contains(ci("", "CI_MERGE_REQUEST_DIFF_BASE_SHA=" + whole).output, "base " + first + ")"));
    ASSERT_EQ(git("checkout -q main").code, 0);
    const Outcome itself = ci();
    EXPECT_EQ(itself.code, 5);
    EXPECT_TRUE(contains(itself.output, "base and head are one commit")) << itself.output;
    const Outcome unknown = ci("--base nowhere");
    EXPECT_EQ(unknown.code, 5);
    EXPECT_TRUE(contains(unknown.output, "the base nowhere is no commit")) << unknown.output;
    const Outcome outside = shell("cd / && shadowbench ci"); // the temporary folder may be in one
    EXPECT_EQ(outside.code, 2);
    EXPECT_TRUE(contains(outside.output, "is in no git repository")) << outside.output;
}

TEST_F(Ci, ARowThatIsGoneOrABaseWithoutAFileIsInconclusive) {
    ASSERT_EQ(git("mv shadows/engine.toml shadows/other.toml").code, 0);
    write("shadows/other.toml", "[[renderer]]\nid = \"other\"\ncommand = '''sh render.sh {out} {out} # {scene}'''\n");
    write("shadowbench.toml", "renderers = [\"shadows/other.toml\"]\nscenes = [\"shadows/tiny.toml\"]\n");
    commit("another row");
    const Outcome gone = ci();
    EXPECT_EQ(gone.code, 5);
    EXPECT_TRUE(contains(gone.output, "external:engine on tiny is no longer measured")) << gone.output;
    ASSERT_EQ(git("checkout -q --orphan bare && git rm -q --cached shadowbench.toml && git commit -q -m bare").code, 0);
    ASSERT_EQ(git("checkout -q -f work").code, 0);
    const Outcome bare = ci("--base bare");
    EXPECT_EQ(bare.code, 5);
    EXPECT_TRUE(contains(bare.output, "the base, bare (")) << bare.output;
    EXPECT_TRUE(contains(bare.output, "the commit has no shadowbench.toml; write one")) << bare.output;
    ASSERT_EQ(git("rm -q shadowbench.toml && git commit -q -m 'no file'").code, 0);
    EXPECT_EQ(ci("--base HEAD~1").code, 2) << "the head's own is what its author has to mend";
}

TEST_F(Ci, FilesToCopyCanBeReadAndNameOptionsThatThereAre) {
    const std::string root = SOURCE_FOLDER, help = shell("shadowbench ci --help").output;
    for (const char* file :
         {"/action.yml", "/docs/ci/adapters.yml", "/docs/ci/engine-github.yml", "/docs/ci/engine-gitlab.yml",
          "/docs/ci/github-actions.yml", "/docs/ci/gitlab-ci.yml", "/docs/ci/technique.yml"}) {
        const Outcome read =
            shell("/usr/bin/python3 -c 'import sys, yaml; yaml.safe_load(open(sys.argv[1]))' " + root + file);
        EXPECT_EQ(read.code, 0) << file << read.output;
    }
    int options = 0;
    for (const char* file : {"/action.yml", "/docs/ci/engine-gitlab.yml", "/docs/ci.md"}) {
        const std::string text = readFile(root + file);
        for (std::size_t at = text.find("shadowbench ci "); at != std::string::npos;
             at = text.find("shadowbench ci ", at + 1)) {
            std::string line = text.substr(at, text.find_first_of("`\n", at + 1) - at);
            for (std::size_t from = line.find("--"); from != std::string::npos;
                 from = line.find("--", from + 2), ++options) {
                const std::string option = line.substr(from, line.find_first_of(" \n", from) - from);
                EXPECT_TRUE(contains(help, option)) << file << ": " << option;
            }
        }
    }
    EXPECT_GE(options, 8);
}

} // namespace
} // namespace shadowbench
