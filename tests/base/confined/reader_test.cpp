// Whatever becomes of the child that reads a file, its parent says one line and goes on.
#include "base/confined/passed_descriptors.h"
#include "base/confined/reader.h"
#include "base/error.h"
#include "base/files.h"
#include "base/limits.h"
#include "base/temporary_folder.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <string>
#include <unistd.h>
#include <vector>

namespace shadowbench {
namespace {

void spin() {
    volatile unsigned turns = 0;
    for (;;) turns = turns + 1;
}

/// Memory that is used, and not only asked for.
void eat() {
    std::vector<std::string> eaten;
    for (;;) eaten.emplace_back(64 << 20, 'x');
}

/// What a reader may do wrong, by the request that asks for it.
const std::map<std::string, std::function<void(ForeignWork&)>>& faults() {
    static const std::map<std::string, std::function<void(ForeignWork&)>> all{
        {"add", [](ForeignWork& work) { work.answer().put(std::uint64_t{contentOf(work.files().front()).size()}); }},
        {"abort", [](ForeignWork&) { std::abort(); }},
        {"crash", [](ForeignWork&) { std::raise(SIGSEGV); }},
        {"leave", [](ForeignWork&) { _exit(0); }},
        {"spin", [](ForeignWork&) { spin(); }},
        {"eat", [](ForeignWork&) { eat(); }},
        {"refuse", [](ForeignWork&) { throw BadInput("line 1\nline \x1b[31m2\x07"); }},
        {"lie", [](ForeignWork& work) { work.answer().put(std::numeric_limits<std::uint64_t>::max()); }},
        {"stop", [](ForeignWork& work) { work.answer(); }},
        {"ramble", [](ForeignWork& work) { work.answer().put(std::string(5000, 'x')); }},
    };
    return all;
}

void misbehave(ForeignWork& work) { faults().at(work.request())(work); }

const ForeignReader misbehaving("misbehaving", misbehave);

class Reader : public testing::Test {
protected:
    std::uint64_t asked(const std::string& request) {
        writeFile(folder_.path() / "file", "12345");
        std::vector<OpenedFile> files;
        files.push_back(openRegular(folder_.path() / "file"));
        ReaderChild child(misbehaving, "cannot add up file", std::move(files), request);
        child.awaitAnswer();
        return request == "ramble" ? child.text(1000).size() : child.number(100, "as a size");
    }
    std::string refusal(const std::string& request) {
        try {
            asked(request);
        } catch (const BadInput& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder_;
};

/// A variable of the environment, while the object lives.
class Set {
public:
    Set(Limit limit, const std::string& value) : name_(variableOf(limit)) { ::setenv(name_.c_str(), value.c_str(), 1); }
    ~Set() { ::unsetenv(name_.c_str()); }

private:
    std::string name_;
};

TEST_F(Reader, ThatIsSoundAnswers) { EXPECT_EQ(asked("add"), 5U); }

TEST_F(Reader, ThatDiesIsNamedWithTheFileAndTheSignal) {
    EXPECT_EQ(refusal("abort"),
              "cannot add up file: its reader was ended by signal 6 (Aborted): the file is damaged; write it again");
    EXPECT_NE(refusal("crash").find(hasSanitizer() ? "ended with code 1" : "signal 11"), std::string::npos);
    EXPECT_NE(refusal("leave").find("ended with code 0 and without an answer"), std::string::npos);
    EXPECT_NE(refusal("stop").find("without an answer"), std::string::npos);
}

TEST_F(Reader, ThatHangsIsEndedByItsTime) {
    const Set seconds(Limit::ReaderSeconds, "1");
    const auto start = std::chrono::steady_clock::now();
    const std::string said = refusal("spin");
    const bool isLate = said ==
                        "cannot add up file: its reader gave no answer for 6 s and was stopped: write the file again, or "
                        "raise SHADOWBENCH_MAX_READER_SECONDS"; // on a machine that gave it less than a sixth of a core
    if (!isLate) {
        EXPECT_EQ(said,
                  "cannot add up file: reading it takes more than 1 s, or more memory than there is: write the file again, "
                  "or raise SHADOWBENCH_MAX_READER_SECONDS");
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST_F(Reader, ThatEatsMemoryIsRefusedMore) {
    if (hasSanitizer()) GTEST_SKIP() << "it needs more memory than any limit";
    const Set memory(Limit::ReaderMib, "700");
    EXPECT_EQ(refusal("eat"),
              "cannot add up file: reading it takes more memory than the 700 MiB of SHADOWBENCH_MAX_READER_MIB, "
              "which can be raised");
}

TEST_F(Reader, WhoseAnswerBreaksARuleIsRefused) {
    EXPECT_NE(refusal("lie").find("its reader's answer is malformed (18446744073709551615 as a size, at most 100 can be)"),
              std::string::npos);
    EXPECT_NE(refusal("ramble").find("answer is malformed (5000 bytes of a text"), std::string::npos);
}

TEST_F(Reader, SaysNothingThatATerminalActsOn) { EXPECT_EQ(refusal("refuse"), "cannot add up file: line 1 line  [31m2"); }

TEST_F(Reader, TakesNoMoreFilesThanItCanBeHanded) {
    writeFile(folder_.path() / "file", "12345");
    std::vector<OpenedFile> files;
    for (std::size_t i = 0; i <= kMostPassed; ++i) files.push_back(openRegular(folder_.path() / "file"));
    EXPECT_THROW(ReaderChild(misbehaving, "cannot add up file", std::move(files), "add"), BadInput);
}

TEST(Limits, AreWholeNumbersThatTheirVariablesSet) {
    EXPECT_EQ(limitOf(Limit::Triangles), 4'000'000U);
    const Set more(Limit::Triangles, "5000000");
    EXPECT_EQ(limitOf(Limit::Triangles), 5'000'000U);
    for (const char* wrong : {"", "0", "-1", "1e6", "12 ", "99999999999999999999"}) {
        const Set nonsense(Limit::Vertices, wrong);
        EXPECT_THROW(limitOf(Limit::Vertices), BadInput) << wrong;
    }
    for (const LimitEntry& entry : limits()) {
        EXPECT_EQ(entry.variable, variableOf(entry.limit));
        EXPECT_LE(entry.usual, entry.most);
    }
}

TEST(Limits, AreThoseOfThePage) {
    const std::string page = readFile(std::string(SOURCE_FOLDER) + "/docs/limits.md");
    for (const LimitEntry& entry : limits()) {
        const std::string row = fmt::format("| `{}` | {} | {} |", entry.variable, entry.usual, entry.bounds);
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
}

} // namespace
} // namespace shadowbench
