// The child's half of reading, spoken to directly: what it is told may be anything, and it ends rather than act on it.
#include "base/confined/reader_server.h"

#include "base/confined/handshake.h"
#include "base/confined/passed_descriptors.h"
#include "base/confined/reader.h"
#include "base/error.h"
#include "base/files.h"
#include "base/limits.h"
#include "base/temporary_folder.h"

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace shadowbench {
namespace {

/// Does what its request says.
void obey(ForeignWork& work) {
    const std::string& request = work.request();
    if (request == "size") work.answer().put(std::uint64_t{contentOf(work.files().front()).size()});
    if (request == "refuse") throw BadInput("it is bad");
    if (request == "fail") throw std::runtime_error("a library gives up");
    if (request == "starve") throw std::bad_alloc();
    if (request == "rest") ::pause();
    if (request != "double") return;
    work.answer();
    while (const auto asked = work.question(100)) work.answer().put(2 * *asked);
}

/// A process that is a server as one that startReader() starts.
class ReaderServer : public testing::Test {
protected:
    ReaderServer() {
        std::array<int, 2> ends{};
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
        requests_ = Descriptor(ends[0]);
        const Descriptor its(ends[1]);
        server_ = ::fork();
        if (server_ == 0) becomeAServer(its.get());
    }
    ~ReaderServer() override { EXPECT_EQ(ended(), 0); }

    /// The server's exit code, once nobody can ask it any more.
    int ended() {
        if (server_ < 0) return 0;
        requests_.close();
        int status = 0;
        EXPECT_EQ(::waitpid(server_, &status, 0), server_);
        server_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    struct Reader {
        Wire wire;
        Descriptor report;

        /// Its exit code; −1 where a signal ended it.
        [[nodiscard]] int ended() const {
            int status = 0;
            EXPECT_EQ(::recv(report.get(), &status, sizeof status, MSG_WAITALL), static_cast<ssize_t>(sizeof status));
            return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        }
    };

    [[nodiscard]] Reader reader() const {
        auto [ours, readers] = makeSockets();
        auto [report, watchers] = makeSockets();
        EXPECT_TRUE(passDescriptors(requests_.get(), 0, std::array{readers.get(), watchers.get()}));
        return {Wire(std::move(ours)), std::move(report)};
    }

    /// One that was told all that it waits for.
    [[nodiscard]] Reader reader(const std::string& request) const {
        Reader asked = reader();
        asked.wire.put(std::uint64_t{2}); // seconds
        tellLimits(asked.wire);
        asked.wire.put(request);
        asked.wire.hand(files_);
        EXPECT_EQ(asked.wire.number(~std::uint64_t{0}, "as magic"), handshake::magic);
        asked.wire.number(~std::uint64_t{0}, "as protections");
        return asked;
    }

    static void tellLimits(Wire& wire) {
        for (const LimitEntry& limit : limits()) wire.put(limitOf(limit.limit));
    }

    static std::string refusalOf(Reader asked) {
        EXPECT_EQ(asked.wire.number(handshake::lastStatus, "as a status"),
                  static_cast<std::uint64_t>(handshake::Status::Refused));
        std::string sentence = asked.wire.text(handshake::longestRefusal);
        EXPECT_EQ(asked.ended(), 0);
        return sentence;
    }

    [[nodiscard]] int requests() const { return requests_.get(); }

private:
    [[noreturn]] static void becomeAServer(int requests) {
        ::setenv(handshake::variable, "obeying", 1);
        ::dup2(requests, 0);
        const ForeignReader other("of another name", obey); // is no server
        const ForeignReader obeying("obeying", obey);       // never returns
        ::_exit(9);
    }
    static std::vector<OpenedFile> opened(const std::filesystem::path& file) {
        writeFile(file, "12345");
        std::vector<OpenedFile> files;
        files.push_back(openRegular(file));
        return files;
    }

    TemporaryFolder folder_;
    std::vector<OpenedFile> files_ = opened(folder_.path() / "file");
    Descriptor requests_{-1};
    pid_t server_ = -1;
};

TEST_F(ReaderServer, ForksAProcessForEachFile) {
    for (int i = 0; i < 3; ++i) {
        Reader asked = reader("size");
        EXPECT_EQ(asked.wire.number(handshake::lastStatus, ""), static_cast<std::uint64_t>(handshake::Status::Answers));
        EXPECT_EQ(asked.wire.number(100, "bytes"), 5U);
        EXPECT_EQ(asked.ended(), 0);
    }
}

TEST_F(ReaderServer, SaysWhyAFileIsRefused) {
    EXPECT_EQ(refusalOf(reader("refuse")), "it is bad");
    EXPECT_EQ(refusalOf(reader("fail")), "a library gives up");
    EXPECT_EQ(refusalOf(reader("starve")),
              "reading it takes more memory than the 4096 MiB of SHADOWBENCH_MAX_READER_MIB, which can be raised");
}

TEST_F(ReaderServer, AnswersQuestionsUntilOneIsOutOfRange) {
    Reader asked = reader("double");
    asked.wire.number(handshake::lastStatus, "");
    for (const std::uint64_t question : {7, 99}) {
        asked.wire.put(question);
        asked.wire.number(handshake::lastStatus, "");
        EXPECT_EQ(asked.wire.number(1000, ""), 2 * question);
    }
    asked.wire.put(std::uint64_t{100});
    EXPECT_EQ(refusalOf(std::move(asked)), "the question is out of range");
}

TEST_F(ReaderServer, EndsAReaderThatIsToldNonsense) {
    Reader seconds = reader();
    seconds.wire.put(std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(seconds.ended(), 1);

    Reader limit = reader();
    limit.wire.put(std::uint64_t{2});
    limit.wire.put(std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(limit.ended(), 1);

    Reader request = reader();
    request.wire.put(std::uint64_t{2});
    tellLimits(request.wire);
    request.wire.put(std::string(5000, 'x'));
    EXPECT_EQ(request.ended(), 1);

    Reader files = reader();
    files.wire.put(std::uint64_t{2});
    tellLimits(files.wire);
    files.wire.put("size");
    files.wire.put(std::uint64_t{3}); // files are announced, and none is handed
    EXPECT_EQ(files.ended(), 1);
}

TEST_F(ReaderServer, EndsAReaderWhoseParentHasGone) {
    Reader gone = reader();
    gone.wire = Wire(Descriptor(-1));
    EXPECT_EQ(gone.ended(), 1);
    Reader abandoned = reader("rest");
    abandoned.report.close();
    EXPECT_THROW(abandoned.wire.number(1, ""), WireError);
}

TEST_F(ReaderServer, PassesOverARequestWithoutItsTwoEnds) {
    EXPECT_TRUE(passDescriptors(requests(), 0, std::array{STDERR_FILENO}));
    EXPECT_TRUE(passDescriptors(requests(), 0, {}));
    EXPECT_EQ(refusalOf(reader("refuse")), "it is bad");
}

} // namespace
} // namespace shadowbench
