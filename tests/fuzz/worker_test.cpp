// A worker is replaced when a library dies in it, and what our own code does wrong in it is a find.
#include "tests/fuzz/worker.h"

#include "base/confined/confinement.h"
#include "base/error.h"

#include <csignal>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace shadowbench::fuzz {
namespace {

bool broken = false; // in a worker, by an input before

/// Stands for a library that reads.
std::string readPlanted(std::string_view input) {
    if (input == "no") throw BadInput("it is bad");
    if (input == "long") throw std::length_error("vector");
    if (input == "wrong") throw std::logic_error("a triangle has a corner that the mesh lacks");
    if (input == "killed") ::raise(SIGKILL);
    for (volatile bool endless = input == "endless"; endless;) {
    }
    if (input == "breaks") broken = true;
    if (input == "suffers" && broken) ::raise(SIGKILL);
    return "read";
}

std::string refusalOf(Worker& worker, std::string_view input) {
    try {
        worker.read(input);
        return "";
    } catch (const BadInput& error) {
        return error.what();
    }
}

TEST(Worker, ReadsInputAfterInput) {
    Worker worker(readPlanted);
    const std::size_t before = workerCounts().workers;
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(refusalOf(worker, "yes"), "");
        EXPECT_EQ(refusalOf(worker, "no"), "its reader refuses it: it is bad");
        EXPECT_EQ(refusalOf(worker, "long"), "its reader refuses it: vector");
    }
    EXPECT_EQ(workerCounts().workers, before + 1);
}

TEST(Worker, ThatSaysWhatMustNotBeIsAFind) {
    Worker worker(readPlanted);
    EXPECT_THROW(worker.read("wrong"), std::logic_error);
    EXPECT_EQ(refusalOf(worker, "yes"), "");
}

TEST(Worker, ThatTakesTooLongIsReplaced) {
    Worker worker(readPlanted);
    const std::size_t before = workerCounts().stopped;
    EXPECT_EQ(refusalOf(worker, "endless"), "its reader was ended");
    EXPECT_EQ(workerCounts().stopped, before + 1);
    EXPECT_EQ(refusalOf(worker, "yes"), "");
}

/// Without sanitizers nobody says whose fault a death is.
TEST(Worker, ThatDiesIsReplaced) {
    if (hasSanitizer()) GTEST_SKIP() << "there it is ours unless a report says otherwise";
    Worker worker(readPlanted);
    const std::size_t before = workerCounts().died;
    EXPECT_EQ(refusalOf(worker, "killed"), "its reader was ended");
    EXPECT_EQ(refusalOf(worker, "yes"), "");
    EXPECT_EQ(refusalOf(worker, "killed"), "its reader was ended");
    EXPECT_EQ(workerCounts().died, before + 2);
}

TEST(Worker, IsNotBlamedForWhatAnEarlierInputHasBroken) {
    Worker worker(readPlanted);
    const std::size_t before = workerCounts().workers;
    EXPECT_EQ(refusalOf(worker, "breaks"), "");
    // A sanitizer's report would make it ours, were it not read again.
    EXPECT_EQ(refusalOf(worker, "suffers"), hasSanitizer() ? "" : "its reader was ended");
    EXPECT_EQ(refusalOf(worker, "suffers"), "");
    EXPECT_EQ(workerCounts().workers, before + 2);
}

/// The copy is a function that sanitizers watch, whatever this file is compiled with.
TEST(Worker, WhoseOwnCodeOverflowsIsAFind) {
    if (!hasSanitizer()) GTEST_SKIP() << "nothing would notice";
    Worker worker([](std::string_view input) {
        const std::unique_ptr<char[]> small(new char[16]);
        std::memcpy(small.get(), input.data(), input.size());
        return std::string(1, small[3]);
    });
    EXPECT_NO_THROW(worker.read("it fits"));
    EXPECT_THROW(worker.read("seventeen letters"), std::logic_error);
}

TEST(Worker, TellsWhatReadersSayApartButForNumbers) {
    std::vector<std::size_t> said;
    onReached([&](std::size_t number) { said.push_back(number); });
    Worker worker([](std::string_view input) { return std::string(input); });
    for (const char* input : {"face 17 is bad", "face 4 is bad", "vertex 4 is bad"}) worker.read(input);
    onReached([](std::size_t) {});
    ASSERT_EQ(said.size(), 3U);
    EXPECT_EQ(said[0], said[1]);
    EXPECT_NE(said[0], said[2]);
}

} // namespace
} // namespace shadowbench::fuzz
