// A run that is interrupted or killed: POV-Ray ends with it, and its folder goes at once or at the next start.
#include "base/temporary_folder.h"
#include "tests/support/povray_stand_in.h"

#include <csignal>
#include <sys/wait.h>

namespace shadowbench::groundtruth {
namespace {

class PovRayInterrupted : public PovRayStandIn {
protected:
    /// Another process of this program that renders without an end, and the process that it started for that.
    struct Run {
        pid_t parent, child;
    };
    [[nodiscard]] Run start() const {
        const povray::Options options = fake(fmt::format("echo $$ > {}; exec sleep 100", file("pid").string()));
        const pid_t parent = fork();
        if (parent == 0) {
            try {
                povray::render(overlappingPlates(), size, 16, options);
            } catch (...) {
            }
            _exit(0);
        }
        return {parent, pidIn("pid")};
    }

    /// The status of `process` after `signal`.
    static int statusAfter(pid_t process, int signal) {
        kill(process, signal);
        int status = 0;
        waitpid(process, &status, 0);
        return status;
    }

    [[nodiscard]] std::size_t folders() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(temporary()), fs::directory_iterator()));
    }
};

TEST_F(PovRayInterrupted, ACallerThatGivesUpLeavesNothingBehind) {
    struct Interrupted {};
    const povray::Options options =
        fake(fmt::format("echo $$ > {}; echo 'Rendered 1024 of 4096 pixels (25%)' >&2; sleep 100", file("pid").string()));
    const Progress interrupt = [](double, std::string_view) { throw Interrupted{}; };
    EXPECT_THROW(povray::render(overlappingPlates(), size, 16, options, interrupt), Interrupted);
    EXPECT_TRUE(endsSoon(pidIn("pid")));
}

TEST_F(PovRayInterrupted, AnInterruptTakesEffectOnceNothingIsLeft) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        fs::remove(file("pid"));
        const Run run = start();
        ASSERT_EQ(folders(), 1U);
        const int status = statusAfter(run.parent, signal);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status; // what a shell expects of Ctrl-C
        EXPECT_EQ(folders(), 0U);
        EXPECT_TRUE(endsSoon(run.child));
    }
}

TEST_F(PovRayInterrupted, ASignalThatTheCallerIgnoresStopsNothing) {
    std::signal(SIGHUP, SIG_IGN); // as under nohup
    const Run run = start();
    std::signal(SIGHUP, SIG_DFL);
    kill(run.parent, SIGHUP);
    std::this_thread::sleep_for(100ms); // five times the tick in which it would have been noticed
    EXPECT_TRUE(alive(run.child));
    statusAfter(run.parent, SIGTERM);
}

TEST_F(PovRayInterrupted, TheFolderOfAKilledRunGoesAtTheNextStart) {
    const Run run = start();
    EXPECT_TRUE(alive(run.child));
    statusAfter(run.parent, SIGKILL);
    EXPECT_TRUE(endsSoon(run.child)); // the render dies with its parent
    ASSERT_EQ(folders(), 1U);         // nobody was there to remove it
    const TemporaryFolder next;
    EXPECT_EQ(folders(), 1U); // the next one's own
    EXPECT_TRUE(fs::exists(next.path()));
}

TEST_F(PovRayInterrupted, TheFolderOfARunThatIsAliveStays) {
    const Run run = start();
    {
        const TemporaryFolder other;
        EXPECT_EQ(folders(), 2U);
    }
    EXPECT_EQ(folders(), 1U);
    EXPECT_TRUE(alive(run.child));
    statusAfter(run.parent, SIGTERM);
}

TEST_F(PovRayInterrupted, NothingButAbandonedFoldersOfOurOwnMakingIsRemoved) {
    const auto privately = [&](const std::string& name) {
        fs::create_directory(temporary() / name);
        fs::permissions(temporary() / name, fs::perms::owner_all);
    };
    privately("shadowbench-private-longer-name");
    privately("shadowbench-abcdef");
    fs::create_directory(temporary() / "shadowbench-private-shared");
    fs::permissions(temporary() / "shadowbench-private-shared", fs::perms::owner_all | fs::perms::group_read);
    writeFile(temporary() / "shadowbench-private-a-file", "");
    privately("aim");
    fs::create_directory_symlink(temporary() / "aim", temporary() / "shadowbench-private-a-link");
    const std::size_t before = folders();
    { const TemporaryFolder other; }
    EXPECT_EQ(folders(), before);
    for (const fs::path& left : fs::directory_iterator(temporary())) fs::remove_all(left);
}

TEST_F(PovRayInterrupted, FoldersMadeAtOnceByManyProcessesAreNotTakenFromThem) {
    constexpr int processes = 8;
    std::vector<pid_t> children;
    for (int i = 0; i < processes; ++i) {
        children.push_back(fork());
        if (children.back() != 0) continue;
        for (int turn = 0; turn < 50; ++turn) {
            const TemporaryFolder folder;
            writeFile(folder.path() / "mine", "");
            if (!fs::exists(folder.path() / "mine")) _exit(1);
        }
        _exit(0);
    }
    for (const pid_t child : children) {
        int status = -1;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
}

} // namespace
} // namespace shadowbench::groundtruth
