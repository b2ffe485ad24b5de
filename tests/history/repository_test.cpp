// What the history asks of git, of a repository of three commits and a branch.
#include "base/error.h"
#include "base/git.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "history/repository.h"

#include <gtest/gtest.h>

namespace shadowbench::history {
namespace {

/// main has the commits "first", "second" and "third"; a branch leaves after the first.
class RepositoryOfFour : public testing::Test {
protected:
    void SetUp() override {
        ask({"init", "-q", "-b", "main"});
        first_ = commit("first", 0);
        ask({"checkout", "-q", "-b", "branch"});
        aside_ = commit("aside", 1);
        ask({"checkout", "-q", "main"});
        second_ = commit("second", 2);
        third_ = commit("third", 3);
        repository_ = Repository::around(folder_.path() / "results" / "history");
        ASSERT_TRUE(repository_);
    }

    std::vector<std::string> ask(const std::vector<std::string>& words) {
        const auto lines = git(folder_.path(), words);
        if (!lines) throw InternalError("git failed");
        return *lines;
    }
    std::string commit(const std::string& subject, int second) {
        Command command{*findProgram("git"), {"-c", "user.name=a", "-c", "user.email=a@b", "commit", "-q"}, folder_.path()};
        command.arguments.insert(command.arguments.end(), {"--allow-empty", "--allow-empty-message", "-m", subject});
        command.environment = ownEnvironment();
        command.environment->push_back("GIT_COMMITTER_DATE=2026-11-21T23:21:3" + std::to_string(second) + "Z");
        if (runProcess(command, [](std::string_view) {}).exitCode != 0) throw InternalError("git commit failed");
        return ask({"rev-parse", "HEAD"}).front();
    }

    TemporaryFolder folder_;
    std::string first_, second_, third_, aside_;
    std::optional<Repository> repository_;
};

TEST_F(RepositoryOfFour, KnowsDateAndSubjectOfItsCommits) {
    EXPECT_EQ(repository_->subject(second_), "second");
    EXPECT_EQ(repository_->date(third_), "20261121T232133Z");
    EXPECT_EQ(repository_->date(third_.substr(0, 7)), "20261121T232133Z");
    for (const std::string& none : {std::string(40, 'a'), third_.substr(0, 6), std::string("main"), std::string()}) {
        EXPECT_FALSE(repository_->date(none)) << none;
        EXPECT_EQ(repository_->subject(none), "") << none;
    }
}

TEST_F(RepositoryOfFour, ACommitMayHaveNoSubject) { EXPECT_EQ(repository_->subject(commit("", 4)), ""); }

TEST_F(RepositoryOfFour, PutsAncestorsFirst) {
    EXPECT_EQ(repository_->inOrder({third_, first_, second_}), (std::vector{first_, second_, third_}));
    EXPECT_FALSE(repository_->inOrder({third_, std::string(40, 'a')}));
    EXPECT_FALSE(repository_->inOrder({third_, "main"}));
}

TEST_F(RepositoryOfFour, SaysWhatTheHeadHasAndTheBaseHasNot) {
    EXPECT_EQ(repository_->between(first_, third_), (std::vector{second_, third_}));
    EXPECT_EQ(repository_->between(aside_, third_), (std::vector{second_, third_})) << "of another branch";
    EXPECT_EQ(repository_->middle(first_, third_), second_);
    for (const auto& [base, head] : {std::pair{std::string("branch"), third_}, std::pair{first_, std::string("main")}}) {
        EXPECT_TRUE(repository_->between(base, head).empty());
        EXPECT_EQ(repository_->middle(base, head), "");
    }
}

TEST(NoRepository, IsAroundNothing) {
    const TemporaryFolder folder;
    EXPECT_FALSE(Repository::around(folder.path()));
}

} // namespace
} // namespace shadowbench::history
