// The parent's half: starts the child, and turns whatever becomes of it into one line.
#include "base/confined/handshake.h"
#include "base/confined/reader.h"
#include "base/error.h"
#include "base/launch.h"
#include "base/limits.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <thread>
#include <valgrind/valgrind.h>

namespace shadowbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int waits = 6; // for an answer, times the processor time: on a busy machine a process gets a share of a core

/// This program's own file. Under Valgrind /proc/self/exe is Valgrind; the link that it shows us is the program.
std::filesystem::path thisProgram() {
    const std::filesystem::path link("/proc/self/exe");
    return RUNNING_ON_VALGRIND != 0 ? std::filesystem::read_symlink(link) : link;
}

constexpr bool reservesAddresses() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return true; // sanitizers: terabytes, so that a limit on them would end the program as it starts
#else
    return false;
#endif
}

/// Of processor time.
std::chrono::seconds secondsFor(const std::vector<OpenedFile>& files) {
    std::uint64_t bytes = 0;
    for (const OpenedFile& file : files) bytes += file.size;
    const std::uint64_t seconds = limitOf(Limit::ReaderSeconds) + (bytes >> 20U);
    return std::chrono::seconds(std::min(seconds, handshake::mostSeconds - 1));
}

Command commandOf(const ForeignReader& reader, std::chrono::seconds seconds) {
    Command command{.program = thisProgram(), .arguments = {}, .folder = "/"};
    command.cpuLimit = seconds + std::chrono::seconds(2); // the child sets a closer one, which says why it was ended
    command.fileLimit = 0;
    command.memoryLimit = limitOf(Limit::ReaderMib) << 20U;
    if (reservesAddresses()) command.memoryLimit.reset();
    command.environment = std::vector<std::string>{fmt::format("{}={}", handshake::variable, reader.name()), "LC_ALL=C"};
    return command;
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
    if (protections.systemCalls || reservesAddresses() || warned.test_and_set()) return;
    fmt::print(stderr,
               "shadowbench: warning: this system filters no system calls (seccomp); foreign files are read with {}\n",
               protections.inWords());
}

} // namespace

struct ReaderChild::Running {
    Child process;
    Wire wire;
    std::chrono::seconds seconds;
    Protections protections;

    /// `reader` on the other end of a new socket.
    static std::unique_ptr<Running> started(const ForeignReader& reader, std::chrono::seconds seconds) {
        const Command command = commandOf(reader, seconds);
        const Launch launch(command);
        auto [ours, childs] = makeSockets();
        const Descriptor nothing = openNothing();
        const pid_t pid = start(launch, childs.get(), nothing.get(), nothing.get());
        return std::unique_ptr<Running>(new Running{Child(pid), Wire(std::move(ours)), seconds, {}});
    }

    [[nodiscard]] Clock::time_point deadline() const { return Clock::now() + waits * seconds; }

    /// Its status, once its end of the socket is closed.
    Finished end() {
        using std::chrono::milliseconds;
        for (int i = 0; i < 1000; ++i) { // it closes before it has ended
            if (const std::optional<int> status = process.poll()) return decoded(*status);
            std::this_thread::sleep_for(milliseconds(2));
        }
        return decoded(process.kill());
    }
};

ReaderChild::ReaderChild(const ForeignReader& reader, std::string doing, std::vector<OpenedFile> files,
                         const std::string& request)
    : doing_(std::move(doing)) {
    if (files.size() > kMostHandedFiles)
        refuse(fmt::format("it names {} files, and at most {} are read", files.size(), kMostHandedFiles));
    running_ = Running::started(reader, secondsFor(files));
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
