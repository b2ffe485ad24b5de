// Asking a running program line by line, with programs that every machine has.
#include "harness/scene/error.h"
#include "harness/scene/process.h"
#include "harness/scene/temporary_folder.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class DialogueWith : public ::testing::Test {
protected:
    [[nodiscard]] Command command(const std::string& program, const std::vector<std::string>& arguments = {}) const {
        Command c{*findProgram(program), arguments, folder_.path()};
        c.limit = std::chrono::milliseconds(300);
        return c;
    }

    TemporaryFolder folder_;
};

TEST_F(DialogueWith, CatAnswersEveryLineWithItself) {
    Dialogue cat(command("cat"));
    EXPECT_EQ(cat.ask("pcss:taps=32+32"), "pcss:taps=32+32");
    EXPECT_EQ(cat.ask(""), "");
    EXPECT_EQ(cat.ask("none"), "none");
}

TEST_F(DialogueWith, AProgramThatHasEndedIsInconclusiveNotASignal) {
    Dialogue ended(command("true"));
    EXPECT_THROW(ended.ask("frame"), Inconclusive);
    EXPECT_THROW(ended.ask("frame"), Inconclusive); // by now it is surely gone: writing to it would raise SIGPIPE
}

TEST_F(DialogueWith, AProgramThatDoesNotAnswerIsLate) {
    Dialogue silent(command("sleep", {"30"}));
    try {
        silent.ask("frame");
        FAIL() << "it answered";
    } catch (const Inconclusive& error) {
        EXPECT_NE(std::string(error.what()).find("did not answer in time"), std::string::npos) << error.what();
    }
}

TEST_F(DialogueWith, AProgramThatIsNotThereCannotBeStarted) {
    Command missing = command("true");
    missing.program = "/nowhere/true";
    EXPECT_THROW(Dialogue{missing}, Inconclusive);
}

} // namespace
} // namespace shadowbench
