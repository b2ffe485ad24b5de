#include "base/launch.h"

#include "base/error.h"
#include "base/faults.h"
#include "base/marked_processes.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace shadowbench {
using faults::fails;
using faults::Point;
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

void limit(__rlimit_resource resource, rlim_t value) {
    const rlimit both{value, value};
    setrlimit(resource, &both);
}

void stayOn(std::optional<int> cpu) {
    if (!cpu) return;
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(*cpu, &only);
    sched_setaffinity(0, sizeof only, &only);
}

/// Why the child could not run the program; 0 when it does (the pipe closes on exec).
int startError(int fd) {
    int error = 0;
    ssize_t count = 0;
    do {
        count = read(fd, &error, sizeof error);
    } while (count < 0 && errno == EINTR);
    return count == sizeof error ? error : 0;
}

} // namespace

std::pair<Descriptor, Descriptor> makePipe() {
    std::array<int, 2> ends{};
    if (fails(Point::Pipe) || pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Inconclusive("cannot start a program: " + reason(errno));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

Descriptor openNothing() {
    Descriptor nothing(fails(Point::Open, "/dev/null") ? -1 : open("/dev/null", O_RDONLY | O_CLOEXEC));
    if (nothing.get() < 0) throw Inconclusive("cannot start a program: /dev/null: " + reason(errno));
    return nothing;
}

Launch::Launch(const Command& c, const std::string& mark) : command(c) {
    words.push_back(c.program.string());
    words.insert(words.end(), c.arguments.begin(), c.arguments.end());
    const char* path = std::getenv("PATH");
    variables = c.environment.value_or(
        std::vector<std::string>{"HOME=" + c.folder.string(), "TMPDIR=" + c.folder.string(), "LC_ALL=C",
                                 std::string("PATH=") + (path != nullptr ? path : "/usr/bin:/bin")});
    const auto inherit = [&](const std::string& name) {
        if (const char* value = std::getenv(name.c_str())) variables.push_back(name + "=" + value);
    };
    for (const std::string& name : c.inherited) inherit(name);
    inherit(faults::variable);
    if (c.threads) variables.push_back(fmt::format("SHADOWBENCH_THREADS={}", *c.threads));
    if (!mark.empty()) variables.push_back(mark);
    for (std::string& word : words) argv.push_back(word.data());
    for (std::string& variable : variables) envp.push_back(variable.data());
    argv.push_back(nullptr);
    envp.push_back(nullptr);
}

void Launch::exec(pid_t parent, int input, int output, int error, int failure) const {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127); // it died before the line above took effect
    limit(RLIMIT_CORE, 0);
    if (command.cpuLimit) limit(RLIMIT_CPU, static_cast<rlim_t>(command.cpuLimit->count()));
    limit(RLIMIT_FSIZE, command.fileLimit);
    if (command.memoryLimit) limit(RLIMIT_AS, *command.memoryLimit);
    if (command.openFiles) limit(RLIMIT_NOFILE, *command.openFiles);
    stayOn(command.cpu);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    std::signal(SIGPIPE, SIG_DFL);

    if (dup2(input, 0) >= 0 && dup2(output, 1) >= 0 && dup2(error, 2) >= 0 && chdir(command.folder.c_str()) == 0)
        execve(argv[0], argv.data(), envp.data());
    const int cause = errno;
    [[maybe_unused]] const ssize_t written = ::write(failure, &cause, sizeof cause);
    _exit(127);
}

pid_t start(const Launch& launch, int input, int output, int error) {
    auto [failure, failureEnd] = makePipe();
    const pid_t parent = getpid();
    const pid_t pid = fails(Point::Fork, launch.argv.front()) ? -1 : fork();
    if (pid < 0) {
        const int reasonNumber = errno;
        throw Inconclusive(fmt::format("cannot start {}: {}", launch.command.program.string(), reason(reasonNumber)),
                           failureOf(reasonNumber));
    }
    if (pid == 0) launch.exec(parent, input, output, error, failureEnd.get());
    setpgid(pid, pid); // here too: whoever is first, the group exists before anyone kills it
    failureEnd.close();
    if (const int failed = startError(failure.get())) {
        waitpid(pid, nullptr, 0);
        throw Inconclusive(fmt::format("cannot start {}: {}", launch.command.program.string(), reason(failed)));
    }
    return pid;
}

std::optional<int> Child::poll() {
    siginfo_t info{};
    // WNOWAIT keeps the process id taken, so that the group can still be killed safely before it is reaped.
    if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0)
        return std::nullopt;
    return kill();
}

void Child::askToEnd(std::chrono::milliseconds grace) {
    ::kill(-pid_, SIGTERM);
    const auto end = std::chrono::steady_clock::now() + grace;
    constexpr std::chrono::milliseconds tick{5};
    while (!poll() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(tick);
}

int Child::kill() {
    ::kill(-pid_, SIGKILL);
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    if (!mark_.empty()) endMarked(mark_);
    return status;
}

Finished decoded(int status) {
    if (WIFSIGNALED(status)) return {.signal = WTERMSIG(status)};
    return {.exitCode = WEXITSTATUS(status)};
}

} // namespace shadowbench
