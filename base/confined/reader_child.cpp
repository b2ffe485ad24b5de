// The parent's half: starts the child, and turns whatever becomes of it into one line.
#include "base/confined/handshake.h"
#include "base/confined/passed_descriptors.h"
#include "base/confined/reader.h"
#include "base/confined/reader_server.h"
#include "base/error.h"
#include "base/launch.h"
#include "base/limits.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <poll.h>
#include <sys/socket.h>

namespace shadowbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int waits = 6; // for an answer, times the processor time: on a busy machine a process gets a share of a core

/// Of processor time.
std::chrono::seconds secondsFor(const std::vector<OpenedFile>& files) {
    std::uint64_t bytes = 0;
    for (const OpenedFile& file : files) bytes += file.size;
    const std::uint64_t seconds = limitOf(Limit::ReaderSeconds) + (bytes >> 20U);
    return std::chrono::seconds(std::min(seconds, handshake::mostSeconds - 1));
}

/// The child's text as one line that does nothing to a terminal.
std::string harmless(std::string text) {
    const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    std::replace_if(text.begin(), text.end(), isControl, ' ');
    const std::size_t end = text.find_last_not_of(' ');
    text.resize(end == std::string::npos ? 0 : end + 1);
    return text;
}

/// How a child ended, for a person.
std::string inWords(const Finished& end, std::chrono::seconds seconds) {
    switch (end.signal) {
    case SIGXCPU:
    case SIGKILL:
        return fmt::format(
            "reading it takes more than {} s, or more memory than there is: write the file again, or raise {}",
            seconds.count(), variableOf(Limit::ReaderSeconds));
    case SIGSYS:
        return "its reader was stopped at a system call that reading a file does not need: the file is damaged, or made to "
               "attack";
    case 0:
        return fmt::format("its reader ended with code {} and without an answer: the file is damaged; write it again",
                           end.exitCode);
    default:
        return fmt::format("its reader was ended by signal {} ({}): the file is damaged; write it again", end.signal,
                           ::strsignal(end.signal));
    }
}

void warnOnce(const Protections& protections) {
    static std::atomic_flag warned;
    if (protections.systemCalls || hasSanitizer() || warned.test_and_set()) return;
    fmt::print(stderr,
               "shadowbench: warning: this system filters no system calls (seccomp); foreign files are read with {}\n",
               protections.inWords());
}

} // namespace

struct ReaderChild::Running {
    Wire wire;
    Descriptor report;
    std::chrono::seconds seconds;
    Protections protections;

    Running(ReaderProcess process, std::chrono::seconds time)
        : wire(std::move(process.conversation)), report(std::move(process.report)), seconds(time) {}

    [[nodiscard]] Clock::time_point deadline() const { return Clock::now() + waits * seconds; }

    /// How it ended, once its end of the conversation is closed.
    [[nodiscard]] Finished end() const {
        constexpr int patience = 5000; // ms: it closes before it has ended
        int status = 0;
        pollfd watched{report.get(), POLLIN, 0};
        const bool reported =
            ::poll(&watched, 1, patience) > 0 && ::recv(report.get(), &status, sizeof status, MSG_WAITALL) == sizeof status;
        return reported ? decoded(status) : Finished{.signal = SIGKILL}; // its server has gone, with all readers
    }
};

ReaderChild::ReaderChild(const ForeignReader& reader, std::string doing, std::vector<OpenedFile> files,
                         const std::string& request)
    : doing_(std::move(doing)) {
    if (files.size() > kMostPassed)
        refuse(fmt::format("it names {} files, and at most {} are read", files.size(), kMostPassed));
    running_ = std::make_unique<Running>(startReader(reader.name()), secondsFor(files));
    Wire& wire = running_->wire;
    wire.put(static_cast<std::uint64_t>(running_->seconds.count()));
    for (const LimitEntry& limit : limits()) wire.put(limitOf(limit.limit));
    wire.put(request);
    wire.hand(files);
    wire.setDeadline(running_->deadline());
    receive([&](Wire& from) {
        if (from.number(~std::uint64_t{0}, "") != handshake::magic)
            throw WireError(WireError::Kind::Malformed, "the reader is another program");
        running_->protections = Protections::unpacked(from.number(~std::uint64_t{0}, ""));
    });
    warnOnce(running_->protections);
}

ReaderChild::ReaderChild(std::string doing, Descriptor answer)
    : doing_(std::move(doing)),
      running_(std::make_unique<Running>(ReaderProcess{std::move(answer), Descriptor(-1)}, std::chrono::seconds(1))) {}

ReaderChild::~ReaderChild() = default;

const Protections& ReaderChild::protections() const { return running_->protections; }

void ReaderChild::ask(std::uint64_t question) {
    running_->wire.put(question);
    running_->wire.setDeadline(running_->deadline());
}

void ReaderChild::awaitAnswer() {
    std::uint64_t status = 0;
    receive([&](Wire& wire) { status = wire.number(handshake::lastStatus, "as a status"); });
    if (status == static_cast<std::uint64_t>(handshake::Status::Refused)) refuse(text(handshake::longestRefusal));
}

std::uint64_t ReaderChild::number(std::uint64_t most, const char* meaning) {
    std::uint64_t number = 0;
    receive([&](Wire& wire) { number = wire.number(most, meaning); });
    return number;
}

std::string ReaderChild::text(std::size_t longest) {
    std::string text;
    receive([&](Wire& wire) { text = wire.text(longest); });
    return harmless(std::move(text));
}

void ReaderChild::refuse(const std::string& sentence) const { throw BadInput(fmt::format("{}: {}", doing_, sentence)); }

void ReaderChild::receive(const std::function<void(Wire&)>& part) {
    try {
        part(running_->wire);
    } catch (const WireError& error) {
        switch (error.kind()) {
        case WireError::Kind::Interrupted:
            throw Inconclusive(fmt::format("{}: the run was interrupted", doing_), Failure::Transient);
        case WireError::Kind::Late:
            refuse(fmt::format("its reader gave no answer for {} s and was stopped: write the file again, or raise {}",
                               (waits * running_->seconds).count(), variableOf(Limit::ReaderSeconds)));
        case WireError::Kind::Malformed:
            refuse(fmt::format("its reader's answer is malformed ({})", error.what()));
        case WireError::Kind::Ended:
            if (running_->report.get() < 0) refuse("its answer ends too early"); // there is no process
            refuse(inWords(running_->end(), running_->seconds));
        }
    }
}

namespace {

void readNothing(ForeignWork& work) { work.answer(); }

const ForeignReader nothingReader("nothing", readNothing);

} // namespace

Protections protectionsHere() {
    ReaderChild child(nothingReader, "cannot start a reader", {});
    child.awaitAnswer();
    return child.protections();
}

} // namespace shadowbench
