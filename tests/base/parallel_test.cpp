// Independent pieces of work on all cores.
#include "base/parallel.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace shadowbench {
namespace {

TEST(InParallel, DoesEachPieceOnce) {
    std::vector<std::atomic<int>> done(100);
    inParallel(done.size(), [&](std::size_t i) { ++done[i]; });
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    inParallel(0, [](std::size_t) { FAIL() << "there is nothing to do"; });
}

TEST(InParallel, ThrowsWhatWasThrownAndBeginsNoMore) {
    std::atomic<int> begun = 0;
    const auto work = [&](std::size_t i) {
        ++begun;
        if (i == 3) throw std::runtime_error("the fourth");
    };
    try {
        inParallel(1'000'000, work);
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the fourth");
    }
    EXPECT_LT(begun, 1'000'000);
}

} // namespace
} // namespace shadowbench
