#include "base/worker_processes.h"

#include "base/error.h"
#include "base/interrupts.h"
#include "base/parallel.h"
#include "base/temporary_folder.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>

namespace shadowbench {
namespace {

/// What `finished` and `lost` are given.
struct Outcome {
    std::map<std::size_t, std::string> answers, lost;

    SharedWork work(std::size_t items, std::function<std::string(std::size_t, const Progress&)> work) {
        return {.items = items,
                .work = std::move(work),
                .finished = [this](std::size_t item, std::string answer) { answers[item] = std::move(answer); },
                .lost = [this](std::size_t item, const std::string& how) { lost[item] = how; }};
    }
};

TEST(WorkerProcesses, DoEveryItemOnce) {
    for (const int workers : {1, 2, 5}) {
        Outcome outcome;
        shareAmongProcesses(workers, outcome.work(12, [](std::size_t i, const Progress&) { return std::to_string(i * i); }));
        ASSERT_EQ(outcome.answers.size(), 12U) << workers;
        for (const auto& [item, answer] : outcome.answers) EXPECT_EQ(answer, std::to_string(item * item));
        EXPECT_TRUE(outcome.lost.empty());
    }
}

TEST(WorkerProcesses, ShareTheThreadsOfTheProcessThatStartsThem) {
    const int here = availableThreads();
    for (const int workers : {1, 2, 3}) {
        Outcome outcome;
        shareAmongProcesses(
            workers, outcome.work(2, [](std::size_t, const Progress&) { return std::to_string(availableThreads()); }));
        const int running = std::min(workers, 2); // there is no work for a third
        for (const auto& [item, answer] : outcome.answers)
            EXPECT_EQ(answer, std::to_string(std::max(1, here / running))) << workers;
    }
    EXPECT_EQ(availableThreads(), here);
}

TEST(WorkerProcesses, AreEndedAfterTheLimitOfTheirItemAndReplaced) {
    Outcome outcome;
    SharedWork work = outcome.work(4, [](std::size_t item, const Progress&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(item == 1 ? 60'000 : item == 2 ? 1500 : 0));
        return std::string("done");
    });
    work.limit = [](std::size_t item) { return std::chrono::seconds(item == 1 ? 1 : 0); }; // 2 has none
    shareAmongProcesses(1, work);
    EXPECT_EQ(outcome.lost, (std::map<std::size_t, std::string>{{1, "took longer than 1 s and was ended"}}));
    EXPECT_EQ(outcome.answers.size(), 3U);
}

TEST(WorkerProcesses, ThatAreEndedForTheirLimitAreToldWithWhatTheyDidLast) {
    Outcome outcome;
    SharedWork work = outcome.work(3, [](std::size_t item, const Progress&) {
        if (item < 2 && !sayDoing(item == 0 ? "the first pass" : std::string(1000, 'a'))) return std::string("not told");
        std::this_thread::sleep_for(std::chrono::milliseconds(item > 0 ? 60'000 : 0));
        return std::string("done");
    });
    work.limit = [](std::size_t) { return std::chrono::seconds(1); };
    shareAmongProcesses(1, work);
    EXPECT_EQ(outcome.lost[1], "took longer than 1 s in " + std::string(255, 'a') + " and was ended");
    EXPECT_EQ(outcome.lost[2], "took longer than 1 s and was ended");
    EXPECT_FALSE(sayDoing("the test"));
}

TEST(WorkerProcesses, HaveNothingToDoWithoutItems) {
    Outcome outcome;
    shareAmongProcesses(2, outcome.work(0, [](std::size_t, const Progress&) { return std::string(); }));
    EXPECT_TRUE(outcome.answers.empty());
}

TEST(WorkerProcesses, KeepWhatTheyMadeAndChangeNothingHere) {
    int here = 0;
    Outcome outcome;
    shareAmongProcesses(1, outcome.work(3, [&here](std::size_t, const Progress&) { return std::to_string(++here); }));
    EXPECT_EQ(outcome.answers, (std::map<std::size_t, std::string>{{0, "1"}, {1, "2"}, {2, "3"}}));
    EXPECT_EQ(here, 0);
}

// The parent's threads end one after the other, and a worker is told so by each that it is handed to.
TEST(WorkerProcesses, ClearUpHoweverOftenTheyAreTold) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "cleared";
    Outcome outcome;
    shareAmongProcesses(1, outcome.work(1, [&](std::size_t, const Progress&) -> std::string {
        const DeferredInterrupts held;
        for (int i = 0; i < 3; ++i) std::raise(SIGTERM);
        if (DeferredInterrupts::pending()) std::ofstream(file) << "all";
        return "";
    }));
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_EQ(outcome.lost, (std::map<std::size_t, std::string>{{0, "was killed by signal 15"}})) << "and then it ends";
}

TEST(WorkerProcesses, ThatThrowSayWhatAndClearUpNothingOfTheirParents) {
    Outcome outcome;
    const TemporaryFolder folder;
    shareAmongProcesses(
        1, outcome.work(1, [](std::size_t, const Progress&) -> std::string { throw std::runtime_error("no context"); }));
    EXPECT_EQ(outcome.lost, (std::map<std::size_t, std::string>{{0, "failed: no context"}}));
    EXPECT_TRUE(std::filesystem::exists(folder.path())) << "removed by the worker";
}

TEST(WorkerProcesses, WorkAtTheSameTime) {
    Outcome outcome;
    shareAmongProcesses(3, outcome.work(3, [](std::size_t, const Progress&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200)); // longer than it takes to start the next
        return std::to_string(getpid());
    }));
    std::set<std::string> processes;
    for (const auto& [item, process] : outcome.answers) processes.insert(process);
    EXPECT_EQ(processes.size(), 3U);
}

TEST(WorkerProcesses, PassLongAnswersWhole) {
    Outcome outcome;
    shareAmongProcesses(2, outcome.work(4, [](std::size_t i, const Progress&) {
        return std::string(3'000'000 + i, static_cast<char>('a' + i));
    }));
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(outcome.answers[i], std::string(3'000'000 + i, static_cast<char>('a' + i)));
}

TEST(WorkerProcesses, ThatEndLoseTheirItemOnly) {
    for (const int workers : {1, 2}) {
        Outcome outcome;
        shareAmongProcesses(workers, outcome.work(6, [](std::size_t i, const Progress&) {
            if (i == 2) std::raise(SIGKILL);
            if (i == 5) _exit(7);
            return std::string("done");
        }));
        EXPECT_EQ(outcome.lost,
                  (std::map<std::size_t, std::string>{{2, "was killed by signal 9"}, {5, "ended with exit code 7"}}))
            << workers;
        EXPECT_EQ(outcome.answers.size(), 4U);
    }
}

TEST(WorkerProcesses, ReportProgress) {
    Outcome outcome;
    SharedWork work = outcome.work(1, [](std::size_t, const Progress& progress) {
        progress(0.5, "half");
        return std::string();
    });
    std::vector<std::string> said;
    work.progress = [&](std::size_t item, double done, std::string_view what) {
        said.push_back(std::to_string(item) + " " + std::to_string(done) + " " + std::string(what));
    };
    shareAmongProcesses(1, work);
    EXPECT_EQ(said, (std::vector<std::string>{"0 0.000000 ", "0 0.500000 half"}));
}

TEST(WorkerProcesses, EndWithAnErrorHere) {
    Outcome outcome;
    SharedWork work = outcome.work(4, [](std::size_t, const Progress&) { return std::string(); });
    work.finished = [](std::size_t, const std::string&) { throw InternalError("the disk is full"); };
    EXPECT_THROW(shareAmongProcesses(2, work), InternalError);
}

TEST(WorkerProcesses, LeaveAfterTheirLastItem) {
    Outcome outcome;
    SharedWork work = outcome.work(2, [](std::size_t, const Progress&) { return std::string(); });
    work.leave = [] { std::raise(SIGKILL); }; // too late to lose an item
    shareAmongProcesses(1, work);
    EXPECT_EQ(outcome.answers.size(), 2U);
    EXPECT_TRUE(outcome.lost.empty());
}

TEST(CheckInOwnProcess, ThrowsHereWhatItThrewThere) {
    int here = 0;
    checkInOwnProcess([&here] { here = 1; });
    EXPECT_EQ(here, 0);
    try {
        checkInOwnProcess([] { throw Inconclusive("nothing draws"); });
        FAIL() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::Inconclusive);
        EXPECT_STREQ(error.what(), "nothing draws");
    }
    EXPECT_THROW(checkInOwnProcess([] { throw std::runtime_error("no memory"); }), Error);
    EXPECT_THROW(checkInOwnProcess([] { raise(SIGKILL); }), InternalError);
}

} // namespace
} // namespace shadowbench
