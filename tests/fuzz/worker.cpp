#include "tests/fuzz/worker.h"

#include "base/confined/confinement.h"
#include "base/confined/wire.h"
#include "base/error.h"
#include "tests/fuzz/fault.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <typeinfo>

// NOLINTBEGIN(bugprone-reserved-identifier): their own names
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));
// NOLINTEND(bugprone-reserved-identifier)

namespace shadowbench::fuzz {
namespace {

constexpr int socket = 0, errors = 2; // descriptors in the worker
constexpr std::size_t longestInput = 1 << 20, longestSentence = 2000;
constexpr std::chrono::seconds patience{15};
constexpr int inputsOfAWorker = 2000; // so that what a library loses of memory stays small

enum class Said : std::uint64_t { Taken, Refused, Wrong };

WorkerCounts counts;
Reached toldOf = [](std::size_t) {};

// ---- in the worker
// ---------------------------------------------------------------------------------------------------------------

/// The signal ends a worker whose input takes longer than a fifth of a second, which is far more than most need.
void allowTime() {
    const itimerval time{{0, 0}, {0, 200'000}};
    ::setitimer(ITIMER_PROF, &time, nullptr);
}

std::pair<Said, std::string> readOne(const Worker::Read& read, const std::string& input) {
    try {
        return {Said::Taken, read(input)};
    } catch (const std::logic_error& error) {
        // What is derived from it is thrown by libraries, and refused by the child that reads.
        return {typeid(error) == typeid(std::logic_error) ? Said::Wrong : Said::Refused, error.what()};
    } catch (const std::exception& error) {
        return {Said::Refused, error.what()};
    }
}

/// It can open nothing, so no symbolizer and no file for a find: those are its parent's.
[[noreturn]] void work(const Worker::Read& read, pid_t parent, int conversation, int report) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
    ::dup2(conversation, socket);
    ::dup2(report, errors);
    ::close_range(errors + 1, ~0U, 0);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_NOFILE, &none);
    ::setrlimit(RLIMIT_CORE, &none);
    ::signal(SIGPROF, SIG_DFL);
    if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(nullptr); // libFuzzer's
    try {
        for (Wire wire{Descriptor(socket)};;) {
            const std::string input = wire.text(longestInput);
            allowTime();
            const auto [said, sentence] = readOne(read, input);
            wire.put(static_cast<std::uint64_t>(said));
            wire.put(std::string_view(sentence).substr(0, longestSentence));
        }
    } catch (const WireError&) {
        ::_exit(0); // the parent needs it no more
    }
}

// ---- in this process
// -------------------------------------------------------------------------------------------------------------

/// Of a sentence without its numbers and what it quotes.
std::size_t kindOf(const std::string& sentence) {
    std::string kind;
    for (const char c : sentence.substr(0, 60))
        if (std::isdigit(static_cast<unsigned char>(c)) == 0) kind += c;
    return std::hash<std::string>{}(kind);
}

bool isOurFault(const std::string& report) {
    static const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    return libraryAtFault(report, program, symbolAt).empty();
}

} // namespace

const WorkerCounts& workerCounts() { return counts; }

void onReached(Reached reached) { toldOf = std::move(reached); }

struct Worker::Outcome {
    enum class Kind { Said, Died, Stopped } kind;
    Said said = Said::Refused;
    std::string text; // what it said, or the sanitizers' report
};

struct Worker::Running {
    pid_t process;
    Wire wire;
    Descriptor report;
    int inputs = 0;

    Running(pid_t worker, Descriptor conversation, Descriptor errors)
        : process(worker), wire(std::move(conversation)), report(std::move(errors)) {}
    ~Running() { end(); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    static std::unique_ptr<Running> start(const Read& read) {
        auto [ours, workers] = makeSockets();
        auto [reports, workersErrors] = makeSockets();
        const pid_t self = ::getpid(), worker = ::fork();
        if (worker < 0) throw std::logic_error("no worker can be started");
        if (worker == 0) work(read, self, workers.get(), workersErrors.get());
        ++counts.workers;
        return std::make_unique<Running>(worker, std::move(ours), std::move(reports));
    }

    /// Its status as of waitpid().
    int end() {
        if (process < 0) return 0;
        ::kill(process, SIGKILL);
        int status = 0;
        while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
        }
        process = -1;
        return status;
    }

    /// What it has written of late.
    std::string written() {
        std::string text;
        std::array<char, 4096> part{};
        for (ssize_t count = 1; count > 0;) {
            count = ::recv(report.get(), part.data(), part.size(), MSG_DONTWAIT);
            if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
        }
        return text;
    }
};

Worker::Worker(Read read) : read_(std::move(read)) {}
Worker::~Worker() = default;

Worker::Outcome Worker::tried(std::string_view input) {
    if (running_ && running_->inputs == inputsOfAWorker) running_.reset();
    if (!running_) running_ = Running::start(read_);
    Running& worker = *running_;
    ++worker.inputs;
    try {
        worker.wire.put(input);
        worker.wire.setDeadline(std::chrono::steady_clock::now() + patience);
        const auto said = static_cast<Said>(worker.wire.number(2, "as an answer"));
        Outcome outcome{Outcome::Kind::Said, said, worker.wire.text(longestSentence)};
        worker.written();
        return outcome;
    } catch (const WireError& error) {
        const bool late = error.kind() != WireError::Kind::Ended;
        std::string text = worker.written();
        const int status = worker.end();
        running_.reset();
        const bool slow = late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF);
        return {slow ? Outcome::Kind::Stopped : Outcome::Kind::Died, Said::Refused, std::move(text)};
    }
}

void Worker::read(std::string_view input) {
    const bool isFirst = !running_ || running_->inputs == inputsOfAWorker;
    Outcome outcome = tried(input);
    bool isOurs = outcome.kind == Outcome::Kind::Died && hasSanitizer() && isOurFault(outcome.text);
    if (isOurs && !isFirst) {
        outcome = tried(input);
        isOurs = outcome.kind == Outcome::Kind::Died && isOurFault(outcome.text);
    }
    if (isOurs) throw std::logic_error("a worker died in our own code: " + outcome.text);
    if (outcome.kind == Outcome::Kind::Died) ++counts.died;
    if (outcome.kind == Outcome::Kind::Stopped) ++counts.stopped;
    if (outcome.kind != Outcome::Kind::Said) throw BadInput("its reader was ended");
    if (outcome.said == Said::Wrong) throw std::logic_error(outcome.text);
    toldOf(kindOf(outcome.text));
    if (outcome.said == Said::Refused) throw BadInput("its reader refuses it: " + outcome.text);
}

} // namespace shadowbench::fuzz
