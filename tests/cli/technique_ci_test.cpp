// The workflow for a repository that holds a technique folder (docs/ci/technique.yml): its steps, run in a clone.
#include "base/files.h"
#include "tests/support/program.h"
#include "tests/support/technique_folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class TechniqueWorkflow : public testing::Test {
protected:
    /// A repository with one commit on main, and a branch.
    void SetUp() override {
        write("technique.toml", mapToml);
        write("resolve.frag", mapShader);
        write("tiny.toml", tinyScene());
        write("expect.toml", "[[expect]]\nscene = \"tiny.toml\"\nholds = [{ technique = \"my:mine\", metric = \"mismatch\", "
                             "below = 0.02, reason = \"a\" }]\n");
        std::filesystem::create_directories(folder_ / "home");
        ASSERT_EQ(git("init -q -b main && git add -A && git commit -q -m first && git checkout -q -b work").code, 0);
    }

    void write(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories(repository_);
        folder_.write("repository/" + file, text);
    }
    [[nodiscard]] std::string there() const {
        return fmt::format("cd {} && export HOME={} GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a "
                           "GIT_COMMITTER_EMAIL=a@b; ",
                           repository_, folder_ / "home");
    }
    Outcome git(const std::string& words) const { return shell(there() + "git " + words); }
    void commit(const std::string& file, const std::string& text) const {
        write(file, text);
        ASSERT_EQ(git("commit -q -a -m changed").code, 0);
    }

    /// The script of a step, as the host runs it.
    [[nodiscard]] Outcome step(const std::string& name, const std::string& base = "main") const {
        const std::string script = folder_.write(
            "step.sh",
            shell("/usr/bin/python3 -c \"import yaml; print([s['run'] for s in yaml.safe_load(open('" SOURCE_FOLDER
                  "/docs/ci/technique.yml'))['jobs']['shadows']['steps'] if s.get('name') == '" +
                  name + "'][0])\"")
                .output);
        return shell(there() + fmt::format("export PATH={}:$PATH FOLDER=. SCENES='--scene tiny.toml' BASE={} RUNNER_TEMP={} "
                                           "GITHUB_STEP_SUMMARY={} SHADOWBENCH_CACHE={}; bash -e {}",
                                           std::filesystem::path(PROGRAM).parent_path().string(), base, folder_ / "temp",
                                           folder_ / "summary.md", folder_.cache(), script));
    }

    Folder folder_;
    std::string repository_ = folder_ / "repository";
};

TEST_F(TechniqueWorkflow, AChangeThatDrawsTheSameIsGreen) {
    commit("resolve.frag", mapShader + "// a comment\n");
    const Outcome check = step("check"), compare = step("compare");
    EXPECT_EQ(check.code, 0) << check.output;
    EXPECT_EQ(compare.code, 0) << compare.output;
    EXPECT_TRUE(contains(compare.output, "1 of 1 expected results compared")) << compare.output;
}

TEST_F(TechniqueWorkflow, AWorseLineIsRedWithSceneClassAndPass) {
    commit("resolve.frag", replaced(mapShader, "receiver.seen ?", "receiver.seen && gl_FragCoord.x > 22.0 ?"));
    const Outcome check = step("check"), compare = step("compare");
    EXPECT_EQ(check.code, 4) << check.output;
    EXPECT_TRUE(contains(check.output, "FAILS  my:mine on tiny: mismatch below 0.02")) << check.output;
    EXPECT_EQ(compare.code, 4) << compare.output;
    EXPECT_TRUE(contains(compare.output, "worse        leak          my:mine on tiny: accuracy.leak")) << compare.output;
    EXPECT_TRUE(contains(compare.output, "; the pass resolve was changed\n")) << compare.output;
    EXPECT_FALSE(contains(compare.output, "the pass depth map")) << compare.output;
    EXPECT_TRUE(contains(compare.output, "::error title=")) << compare.output;
    EXPECT_TRUE(contains(readFile(folder_ / "summary.md"), "my:mine on tiny"));
}

TEST_F(TechniqueWorkflow, ALineThatDoesNotCompileIsRedWithItsPlace) {
    commit("resolve.frag", replaced(mapShader, "receiver.seen ?", "receiver.sen ?"));
    const Outcome check = step("check"), compare = step("compare");
    EXPECT_EQ(check.code, 2) << check.output;
    EXPECT_TRUE(contains(check.output, "resolve.frag:8: error: ")) << check.output;
    EXPECT_EQ(compare.code, 5) << compare.output;
    EXPECT_TRUE(contains(compare.output, "my:mine on tiny: ") && contains(compare.output, "resolve.frag:8: "))
        << compare.output;
}

TEST_F(TechniqueWorkflow, AFirstCommitHasNothingToBeWorseThan) {
    ASSERT_EQ(git("checkout -q --orphan empty && git rm -q -f --cached technique.toml && git commit -q -m none && git "
                  "checkout -q -f work")
                  .code,
              0);
    EXPECT_EQ(step("compare", "empty").code, 0);
    EXPECT_EQ(step("compare", "0000000000000000000000000000000000000000").code, 0);
}

} // namespace
} // namespace shadowbench
