// Independent pieces of work on several threads.
#include "base/confined/confinement.h"
#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace shadowbench {
namespace {

TEST(InParallel, DoesEachPieceOnce) {
    for (const int threads : {1, 2, 200}) {
        std::vector<std::atomic<int>> done(100);
        inParallel(100, threads, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
        for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1) << threads;
    }
    inParallel(0, 2, [](int) { FAIL() << "there is nothing to do"; });
}

/// In a process that may have no more memory, of which each thread takes some for its stack.
TEST(InParallel, GoesOnWithoutThreadsThatCannotBeStarted) {
    // A sanitizer's runtime allocates memory for each thread. Where it cannot, it ends the process, and our code never
    // learns of it.
    if (hasSanitizer()) GTEST_SKIP() << "a sanitizer ends a process that has no more memory";
    const auto alone = [] {
        const rlimit none{1, 1};
        setrlimit(RLIMIT_AS, &none);
        try {
            for (;;) std::thread(pause).detach(); // on stacks that are kept from earlier threads
        } catch (const std::system_error&) {
        }
        int done = 0;
        const std::thread::id here = std::this_thread::get_id();
        inParallel(8, 4, [&](int) { done += std::this_thread::get_id() == here ? 1 : 100; });
        _exit(done);
    };
    EXPECT_EXIT(alone(), testing::ExitedWithCode(8), "");
}

TEST(InParallel, ThrowsWhatWasThrownAndBeginsNoMore) {
    std::atomic<int> begun = 0;
    const auto work = [&](int i) {
        ++begun;
        if (i == 3) throw std::runtime_error("the fourth");
    };
    try {
        inParallel(1'000'000, availableThreads(), work);
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the fourth");
    }
    EXPECT_LT(begun, 1'000'000);
}

TEST(InParallel, ReportsProgressFromTheCallingThread) {
    std::vector<double> seen;
    const std::thread::id caller = std::this_thread::get_id();
    const Progress progress = [&](double done, std::string_view what) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_EQ(what, "counting");
        seen.push_back(done);
    };
    inParallel(50, 1, progress, "counting", [](int) {});
    ASSERT_EQ(seen.size(), 50U);
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_EQ(seen.back(), 1);
    inParallel(50, 3, progress, "counting", [](int) {});
}

TEST(InParallelParts, CoverEverythingOnce) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{10}, std::size_t{100'001}}) {
        std::vector<std::atomic<int>> done(count);
        inParallelParts(count, 3, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) ++done[i];
        });
        EXPECT_TRUE(std::ranges::all_of(done, [](const std::atomic<int>& times) { return times == 1; })) << count;
    }
}

} // namespace
} // namespace shadowbench
