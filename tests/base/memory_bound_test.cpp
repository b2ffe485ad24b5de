// A library that takes all memory, or all of the stack, is one sentence.
#include "base/confined/confinement.h"
#include "base/error.h"
#include "base/memory_bound.h"
#include "base/worker_processes.h"
#include "tests/support/message_of.h"

#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>
#include <vector>

namespace shadowbench {
namespace {

constexpr std::uint64_t bound = 64 << 20;

/// What a worker's parent is told of `use` within the bound.
std::string told(void (*use)()) {
    return test::messageOf<Error>([&] {
        checkInOwnProcess([&] {
            const MemoryBound held(bound, "mine.frag: too large");
            use();
        });
    });
}

int deep(int n) {
    volatile char frame[4096] = {};
    return n == 0 ? 0 : deep(n - 1) + frame[n % 4096];
}

TEST(MemoryBound, IsTheSentenceOfAWorkerThatASignalEnds) {
    if (hasSanitizer()) GTEST_SKIP() << "sanitizers have bounds of their own";
    EXPECT_EQ(told([] {
                  for (;;) *static_cast<volatile char*>(std::malloc(1 << 20)) = 1; // as Mesa does
              }),
              "mine.frag: too large");
    EXPECT_EQ(told([] { std::abort(); }), "mine.frag: too large");
    EXPECT_EQ(told([] { deep(1 << 20); }), "mine.frag: too large");
    EXPECT_EQ(told([] {}), "");
}

TEST(MemoryBound, EndsWithTheObject) {
    if (hasSanitizer()) GTEST_SKIP() << "sanitizers have bounds of their own";
    const auto allocate = [] { return std::vector<char>(2 * bound).size(); };
    {
        const MemoryBound held(bound, "too large");
        EXPECT_THROW(allocate(), std::bad_alloc);
        EXPECT_EQ(std::vector<char>(bound / 2).size(), bound / 2);
    }
    EXPECT_EQ(allocate(), 2 * bound);
    EXPECT_EXIT(std::raise(SIGSEGV), testing::KilledBySignal(SIGSEGV), "");
}

} // namespace
} // namespace shadowbench
