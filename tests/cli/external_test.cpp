// Renderers that are not ours, called by `run`: shell scripts that copy our own images, and one for each way to fail.
#include "base/files.h"
#include "harness/records/record.h"
#include "harness/runs/merge.h"
#include "tests/support/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <optional>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A renderer whose command is a line for the shell.
std::string entry(const std::string& id, const std::string& line, const std::string& more = "") {
    return fmt::format("[[renderer]]\nid = \"{}\"\ncommand = '''{} # {{scene}} {{out}}'''\n{}\n", id, line, more);
}

class External : public testing::Test {
protected:
    /// Our own images, which the scripts copy.
    static void SetUpTestSuite() {
        shared_ = std::make_unique<Folder>();
        const Outcome own = shell("shadowbench run --quiet --cost none --images --technique pcf --technique pcf:map=64 "
                                  "--technique none --scene " +
                                  scene() + options() + " --out " + own_());
        ASSERT_EQ(own.code, 0) << own.output;
    }
    static void TearDownTestSuite() { shared_.reset(); }

    static std::string own_() { return *shared_ / "own"; }
    static std::string images() { return own_() + "/images/tiny/pcf"; }
    static std::string scene() { return shared_->write("tiny.toml", tinyScene()); }
    static std::string options() { return " --cache " + shared_->cache(); }
    static std::string copies() { return "cp " + images() + "/frame-*.exr {out}"; }

    [[nodiscard]] Outcome run(const std::string& more) const {
        return shell("shadowbench run --quiet --cost none --scene " + scene() + options() + " --external " + file_ +
                     " --out " + out_ + " " + more);
    }
    [[nodiscard]] std::vector<Record> records() const { return readRecords(out_ + "/results.jsonl"); }
    [[nodiscard]] std::optional<Record> record(const std::string& variant) const {
        for (const Record& record : records())
            if (record.variant == variant) return record;
        return std::nullopt;
    }
    void write(const std::string& text) const { folder_.write("renderers.toml", text); }

    static std::unique_ptr<Folder> shared_;
    Folder folder_;
    std::string file_ = folder_ / "renderers.toml", out_ = folder_ / "out";
};

std::unique_ptr<Folder> External::shared_;

TEST_F(External, RowScoresAsTheTechniqueThatDrewTheImages) {
    write(entry("copy", copies() + "; echo '{\"milliseconds\": 1.25, \"device\": \"a fast GPU\"}' > {out}/timing.json",
                "title = \"Our own\"\nsource = \"a copy\"\nsettings = { map = 1024 }"));
    const Outcome outcome = run("--technique pcf --technique 'external:*' --images");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::optional<Record> ours = record("pcf"), copy = record("external:copy");
    ASSERT_TRUE(ours && copy);
    for (const metrics::Metric& line : metrics::linesOf("accuracy"))
        EXPECT_EQ(ours->values[line], copy->values[line]) << line.path;
    for (const metrics::Metric& line : metrics::linesOf("stability"))
        if (!line.list) {
            EXPECT_EQ(ours->values[line], copy->values[line]) << line.path;
        }
    EXPECT_EQ(ours->images, copy->images) << "the same frames";
    for (const char* kept : {"/visibility.exr", "/sequence.png", "/flicker.png"})
        EXPECT_EQ(readFile(out_ + "/images/tiny/external_copy" + kept), readFile(images() + kept)) << kept;

    EXPECT_FALSE(copy->values["cost.time.median"]) << "not measured here";
    ASSERT_TRUE(copy->external && copy->external->reported);
    EXPECT_EQ(copy->external->reported->milliseconds, 1.25);
    EXPECT_TRUE(contains(outcome.output, "external:copy")) << outcome.output;
    const std::string page = readFile(out_ + "/report.md");
    EXPECT_TRUE(
        contains(page, "as the renderers themselves report it, not measured here: external:copy 1.25 ms (a fast GPU)"));
    EXPECT_TRUE(contains(page, "external:copy: Our own (a copy)"));
    EXPECT_TRUE(contains(page, "--technique external:copy --external RENDERERS.toml")) << page;
    EXPECT_TRUE(contains(readFile(out_ + "/results.csv"), "external.reported.milliseconds"));
}

TEST_F(External, RowThatFailedStaysWhenARunGoesOnWithOthers) {
    write(entry("broken", "exit 3"));
    EXPECT_EQ(run("--technique 'external:*'").code, 5);
    ASSERT_TRUE(record("external:broken"));
    const Outcome other = run("--technique none --resume");
    EXPECT_EQ(other.code, 0) << other.output;
    ASSERT_TRUE(record("external:broken")) << "it was not chosen, and not made again";
    EXPECT_EQ(record("external:broken")->status, Status::Error);
    EXPECT_TRUE(record("none"));

    write(entry("broken", copies()));
    EXPECT_EQ(run("--technique 'external:*' --resume").code, 0);
    EXPECT_EQ(record("external:broken")->status, Status::Scored);
    EXPECT_EQ(records().size(), 2U);
}

TEST_F(External, EachFailureIsOneLineAndHarmsNoOtherRow) {
    const std::string small = "printf 'Pf\\n2 2\\n-1.0\\n0000000000000000' > {out}/frame-";
    write(entry("hangs", "sleep 300 & sleep 300", "time_limit = 0.5") + entry("dies", "kill -SEGV $$") +
          entry("fails", "echo no GPU >&2; exit 3") + entry("floods", "yes") + entry("nothing", "true") +
          entry("still-only", "cp " + images() + "/frame-2.exr {out}") +
          entry("half", copies() + "; for f in {out}/*; do head -c 300 $f > half; mv half $f; done") +
          entry("small", small + "2.pfm; " + small + "3.pfm") +
          entry("timing", copies() + "; echo '{' > {out}/timing.json") + entry("good", copies()));
    const Outcome outcome = run("--technique pcf --technique 'external:*'");
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    const auto says = [&](const std::string& id, const std::string& what) {
        const std::string line = "error: external:" + id + " on tiny: ";
        const std::size_t at = outcome.output.find(line);
        ASSERT_NE(at, std::string::npos) << id << "\n" << outcome.output;
        EXPECT_EQ(outcome.output.find(line, at + 1), std::string::npos) << "one line";
        const std::string said = outcome.output.substr(at + line.size(), outcome.output.find('\n', at) - at - line.size());
        EXPECT_TRUE(contains(said, what)) << id << ": " << said;
        EXPECT_FALSE(contains(said, "shadowbench-private")) << "a folder that is gone: " << said;
        EXPECT_EQ(record("external:" + id)->status, Status::Error);
    };
    says("hangs", "did not end within its time_limit of 0.5 s and was killed");
    says("dies", "was ended by signal 11 (Segmentation fault)");
    says("fails", "ended with exit code 3; it last said: no GPU");
    says("floods", "wrote more than 16 MiB to its standard output and was killed");
    says("nothing", "wrote no image of frames 2, 3");
    says("still-only", "wrote no image of frame 3");
    says("half", "frame-2.exr");
    says("small", "frame-2.pfm has 2 × 2 pixels");
    says("timing", "its timing.json is no JSON object");
    EXPECT_EQ(record("pcf")->status, Status::Scored);
    EXPECT_EQ(record("external:good")->status, Status::Scored);
}

TEST_F(External, RowsOnTheStillFrameAloneHaveNoStability) {
    write(entry("still", "cp " + images() + "/frame-2.exr {out}; echo {frames} > frames", "frames = \"still\""));
    ASSERT_EQ(run("--technique 'external:still'").code, 0);
    EXPECT_EQ(readFile(folder_ / "frames"), "2\n");
    EXPECT_TRUE(record("external:still")->values["accuracy.mismatch"]);
    EXPECT_FALSE(record("external:still")->values["stability.flicker.mean"]);
}

TEST_F(External, FinishedCellsAreKeptUntilSomethingOfThemChanges) {
    const auto calls = [&] { return readFile(folder_ / "calls"); };
    const std::string script =
        folder_.write("copy.sh", "echo $1 >> calls\n" + std::string("cp ") + images() + "/frame-*.exr $2\n");
    const auto renderers = [&](const std::string& more) {
        return "[[renderer]]\nid = \"a\"\ncommand = [\"sh\", \"copy.sh\", \"{frames}\", \"{out}\", \"{scene}\"]\n" + more;
    };
    write(renderers(""));
    ASSERT_EQ(run("--technique 'external:*'").code, 0);
    ASSERT_EQ(run("--technique 'external:*' --resume").code, 0);
    EXPECT_EQ(calls(), "2,3\n");
    write("# a comment changes nothing\n" + renderers(""));
    ASSERT_EQ(run("--technique 'external:*' --resume").code, 0);
    EXPECT_EQ(calls(), "2,3\n");
    write(renderers("settings = { map = 2048 }"));
    ASSERT_EQ(run("--technique 'external:*' --resume").code, 0);
    EXPECT_EQ(calls(), "2,3\n2,3\n") << "the entry says something else";
    folder_.write("copy.sh", readFile(script) + "# another script\n");
    ASSERT_EQ(run("--technique 'external:*' --resume").code, 0);
    EXPECT_EQ(calls(), "2,3\n2,3\n2,3\n") << "a file that the command names is another";
    ASSERT_EQ(run("--technique 'external:*'").code, 0);
    EXPECT_EQ(calls(), "2,3\n2,3\n2,3\n2,3\n") << "without --resume all is called again";
}

TEST_F(External, AStoppedRunLeavesNoProcessAndGoesOn) {
    const std::string hang = "echo $$ > pid; [ -e second ] || setsid sleep 300 || true; ";
    write(entry("a-first", copies() + "; echo x >> first") + entry("b-second", hang + copies()));
    const std::string program = "shadowbench run --quiet --cost none --jobs 1 --scene " + scene() + options() +
                                " --external " + file_ + " --out " + out_ + " --technique 'external:*'";
    // The shell has the program's id, not the caller's: background jobs of a shell ignore SIGINT, so it is SIGTERM.
    const Outcome stopped = shell("(exec " + program + ") & run=$!; while [ ! -s " + (folder_ / "pid") +
                                  " ]; do sleep 0.05; done; kill -TERM $run; wait $run");
    EXPECT_EQ(stopped.code, 128 + 15) << stopped.output;
    // What the run's own process still has to remove may wait for a busy disk; a renderer that is left sleeps for longer.
    const std::string left = "for i in $(seq 100); do grep -lza '^PWD=" + fs::path(file_).parent_path().string() +
                             "' /proc/[0-9]*/environ 2>/dev/null | grep . || exit 0; sleep 0.3; done; exit 1";
    EXPECT_EQ(shell("cd / && " + left).code, 0) << "a process is left";
    EXPECT_EQ(records().size(), 1U);
    folder_.write("second", "");
    const Outcome resumed = shell(program + " --resume");
    EXPECT_EQ(resumed.code, 0) << resumed.output;
    EXPECT_EQ(readFile(folder_ / "first"), "x\n") << "called once";
    EXPECT_EQ(records().size(), 2U);
}

TEST_F(External, ShardsAndAWholeRunGiveTheSameRecords) {
    write(entry("a", copies()) + entry("b", "exit 1") + entry("soft", "true", "definition = \"area\""));
    const std::string choice = "--technique pcf --technique 'external:*'";
    EXPECT_EQ(run(choice).code, 5);
    EXPECT_EQ(record("external:soft")->status, Status::NotApplicable);
    EXPECT_TRUE(contains(record("external:soft")->reason, "light of kind point")) << record("external:soft")->reason;
    std::vector<std::string> whole;
    for (const Record& record : records()) whole.push_back(toJson(shards::withoutTimings(record)));
    out_ = folder_ / "parts";
    EXPECT_EQ(run(choice + " --shard 1/2").code, 0);
    EXPECT_EQ(run(choice + " --shard 2/2").code, 0);
    EXPECT_EQ(shell("shadowbench merge " + out_).code, 5) << "b failed";
    std::vector<std::string> merged;
    for (const Record& record : records()) merged.push_back(toJson(shards::withoutTimings(record)));
    EXPECT_EQ(merged, whole);
}

TEST_F(External, CompareAndGateJudgeTheNextVersionOfARenderer) {
    write(entry("a", copies()));
    ASSERT_EQ(run("--technique 'external:*' --images").code, 0);
    const std::string before = out_;
    out_ = folder_ / "same";
    ASSERT_EQ(run("--technique 'external:*'").code, 0);
    EXPECT_EQ(shell("shadowbench compare " + before + " " + out_).code, 0);
    // A version without shadows has no boundary whose place could be compared.
    write(entry("a", "cp " + images() + "/../none/frame-*.exr {out}", "force = true"));
    out_ = folder_ / "lost";
    ASSERT_EQ(run("--technique 'external:*'").code, 0);
    const Outcome lost = shell("shadowbench compare " + before + " " + out_);
    EXPECT_EQ(lost.code, 5) << lost.output;
    EXPECT_TRUE(contains(lost.output, "edge_error.missing 0 → 1")) << lost.output;

    write(entry("a", "cp " + images() + "_map=64/frame-*.exr {out}"));
    out_ = folder_ / "worse";
    ASSERT_EQ(run("--technique 'external:*'").code, 0);
    const Outcome compared = shell("shadowbench compare " + before + " " + out_);
    EXPECT_EQ(compared.code, 4) << compared.output;
    EXPECT_TRUE(contains(compared.output, "external:a")) << compared.output;

    const std::string gate = "cd " + (folder_ / "") + " && shadowbench gate --quiet --cost none --scene " + scene() +
                             options() + " --technique 'external:*' --external " + file_ + " --out " + (folder_ / "gate") +
                             " --base ";
    const Outcome judged = shell(gate + before + "/results.jsonl");
    EXPECT_EQ(judged.code, 4) << judged.output;
    EXPECT_TRUE(contains(judged.output, "--external " + file_)) << "how to see it again\n" << judged.output;
    for (const char* side : {"head", "base"})
        EXPECT_TRUE(fs::exists(folder_ / fmt::format("gate/pictures/{}/images/tiny/external_a/visibility.png", side)))
            << side;
    EXPECT_TRUE(contains(readFile(folder_ / "gate/gate.html"), ">head: orange too dark, blue too bright<"));
    EXPECT_FALSE(fs::exists(folder_ / "gate/others"));
    const Outcome program = shell(gate + PROGRAM);
    EXPECT_EQ(program.code, 2) << program.output;
    EXPECT_TRUE(contains(program.output, "--external needs records as --base")) << program.output;
}

TEST_F(External, TheGateCallsARendererAsRunDoesAndKeepsWhatItSaid) {
    write(entry("a", "echo $(ulimit -n) $(ulimit -v) $HOME $MINE >> seen; " + copies()));
    ASSERT_EQ(shell("cd " + (folder_ / "") +
                    " && git init -q -b main . && git -c user.name=a -c user.email=a@b commit -q "
                    "--allow-empty -m first")
                  .code,
              0);
    const std::string as = "ulimit -n 777; export HOME=/somewhere MINE=mine; cd " + (folder_ / "") + "; ";
    const std::string choice =
        " --quiet --cost none --scene " + scene() + options() + " --technique 'external:*' --external renderers.toml --out ";
    ASSERT_EQ(shell(as + "shadowbench run" + choice + "before").code, 0);
    const Outcome green = shell(as + "shadowbench gate --base before" + choice + "after");
    EXPECT_EQ(green.code, 0) << green.output;
    const std::string line = "777 " + shell("echo -n $(ulimit -v)").output + " /somewhere mine\n";
    EXPECT_EQ(readFile(folder_ / "seen"), line + line);
    const std::string crashes = "for i in $(seq 24); do echo line $i of it; done; echo '<i>line 25'; exit 3";
    write(entry("a", crashes) + entry("b", crashes));
    const Outcome crashed = shell(as + "shadowbench gate --base before" + choice + "after");
    EXPECT_EQ(crashed.code, 5) << crashed.output;
    EXPECT_TRUE(contains(crashed.output, "external:a on tiny and 1 more that said the same; its last lines, of "))
        << crashed.output;
    EXPECT_TRUE(contains(crashed.output, "line 6 of it") && !contains(crashed.output, "line 5 of it")) << crashed.output;
    EXPECT_TRUE(contains(readFile(folder_ / "after/gate.html"), "&lt;i&gt;line 25\n"));
    EXPECT_TRUE(readFile(folder_ / "after/logs/tiny/external_a.txt").starts_with("line 1 of it\n"));
}

TEST_F(External, RecordsSayTheRevisionOfTheRenderer) {
    const auto revision = [&](const std::string& id) { return record("external:" + id)->external->revision; };
    write(entry("a", copies()) + entry("b", "exit 1") + entry("soft", "true", "definition = \"area\""));
    const std::string git = "cd " + (folder_ / "") + " && git -c user.name=a -c user.email=a@b ";
    ASSERT_EQ(
        shell(git + "init -q . && git add renderers.toml && git -c user.name=a -c user.email=a@b commit -q -m one").code, 0);
    const std::string hash = shell(git + "rev-parse HEAD").output.substr(0, 40);
    EXPECT_EQ(run("--technique 'external:*'").code, 5);
    for (const char* id : {"a", "b", "soft"}) EXPECT_TRUE(!revision(id).empty() && hash.starts_with(revision(id))) << id;
    write("# changed\n" + readFile(file_));
    (void)run("--technique 'external:*'");
    EXPECT_TRUE(revision("a").ends_with("-dirty")) << revision("a");
    (void)run("--technique 'external:*' --revision v4.2");
    EXPECT_EQ(revision("b"), "v4.2");
}

TEST_F(External, WhatARendererSaidBeforeItFailedIsKept) {
    write(entry("a", "echo one; echo two >&2; exit 3"));
    const Outcome failed = run("--technique 'external:*'");
    EXPECT_TRUE(contains(failed.output, "\n  one\n  two\nall of its output: " + out_ + "/logs/tiny/external_a.txt\n"))
        << failed.output;
    EXPECT_EQ(readFile(out_ + "/logs/tiny/external_a.txt"), "one\ntwo\n");
    write(entry("a", "echo one; " + copies()));
    ASSERT_EQ(run("--technique 'external:*'").code, 0);
    EXPECT_FALSE(fs::exists(out_ + "/logs/tiny/external_a.txt")) << "it did not fail";
}

TEST_F(External, WrongChoicesAreRefusedBeforeAnythingRuns) {
    write(entry("good", copies()));
    EXPECT_EQ(run("--technique external:god").code, 2);
    EXPECT_TRUE(contains(run("--technique external:god").output, "did you mean \"external:good\"?"));
    EXPECT_TRUE(contains(run("--external " + file_).output, "the renderer good is in another file of --external, too"));
    const Outcome without = shell("shadowbench run --quiet --technique 'external:*' --scene " + scene());
    EXPECT_EQ(without.code, 2);
    EXPECT_TRUE(contains(without.output, "name it with --external")) << without.output;
    write("[[renderer]]\nid = \"x\"\ncommand = [\"a\"]\n");
    EXPECT_TRUE(contains(run("").output, "renderers.toml:3: renderer[1].command: {scene} is missing"));
    EXPECT_FALSE(fs::exists(out_));
}

} // namespace
} // namespace shadowbench
