#include "base/process.h"

#include "base/descriptor.h"
#include "base/error.h"
#include "base/interrupts.h"
#include "base/marked_processes.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace shadowbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t longestLine = 4096;    // a child that never ends a line must not fill our memory
constexpr std::uintmax_t fullPipe = 1 << 20; // bytes, the most that a pipe holds

std::string reason(int error) { return std::generic_category().message(error); }

std::pair<Descriptor, Descriptor> makePipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Inconclusive("cannot start a program: " + reason(errno));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

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

/// Everything the child needs, laid out before the fork: afterwards only async-signal-safe calls are allowed.
struct Launch {
    const Command& command;
    std::vector<std::string> words, variables;
    std::vector<char*> argv, envp;

    /// `mark`: a variable by which what the child starts is known again; "": none.
    explicit Launch(const Command& c, const std::string& mark = "") : command(c) {
        words.push_back(c.program.string());
        words.insert(words.end(), c.arguments.begin(), c.arguments.end());
        const char* path = std::getenv("PATH");
        variables = c.environment.value_or(
            std::vector<std::string>{"HOME=" + c.folder.string(), "TMPDIR=" + c.folder.string(), "LC_ALL=C",
                                     std::string("PATH=") + (path != nullptr ? path : "/usr/bin:/bin")});
        for (const std::string& name : c.inherited)
            if (const char* value = std::getenv(name.c_str())) variables.push_back(name + "=" + value);
        if (!mark.empty()) variables.push_back(mark);
        for (std::string& word : words) argv.push_back(word.data());
        for (std::string& variable : variables) envp.push_back(variable.data());
        argv.push_back(nullptr);
        envp.push_back(nullptr);
    }

    /// In the child. Reports errno through `failure` when the program cannot be run.
    [[noreturn]] void exec(pid_t parent, int input, int output, int error, int failure) const {
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
        [[maybe_unused]] const ssize_t written = write(failure, &cause, sizeof cause);
        _exit(127);
    }
};

/// Why the child could not run the program; 0 when it does (the pipe closes on exec).
int startError(int fd) {
    int error = 0;
    ssize_t count = 0;
    do {
        count = read(fd, &error, sizeof error);
    } while (count < 0 && errno == EINTR);
    return count == sizeof error ? error : 0;
}

/// Starts the program with these descriptors as its standard ones; returns once it runs.
pid_t start(const Launch& launch, int input, int output, int error) {
    auto [failure, failureEnd] = makePipe();
    const pid_t parent = getpid();
    const pid_t pid = fork();
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

Descriptor openNothing() {
    Descriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
    if (nothing.get() < 0) throw Inconclusive("cannot start a program: /dev/null: " + reason(errno));
    return nothing;
}

/// A file in `folder` that is gone when nobody has it open.
Descriptor openNameless(const std::filesystem::path& folder) {
    Descriptor file(open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR));
    if (file.get() < 0) throw Inconclusive(fmt::format("cannot start a program: {}: {}", folder.string(), reason(errno)));
    return file;
}

/// The last line of a file, without its end; nothing if it is empty.
std::string lastLine(int file) {
    std::array<char, longestLine> buffer{};
    const off_t size = lseek(file, 0, SEEK_END);
    const ssize_t count =
        pread(file, buffer.data(), buffer.size(), std::max<off_t>(0, size - static_cast<off_t>(buffer.size())));
    std::string_view text(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count)));
    while (text.ends_with('\n')) text.remove_suffix(1);
    return std::string(text.substr(text.rfind('\n') + 1)); // npos + 1 is the start
}

/// A running child, killed with its group when it goes out of scope; with `mark`, all that have it in their environment.
class Child {
public:
    explicit Child(pid_t pid, std::string mark = "") : pid_(pid), mark_(std::move(mark)) {}
    ~Child() {
        if (pid_ > 0) kill();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// The status if it has ended.
    std::optional<int> poll() {
        siginfo_t info{};
        // WNOWAIT keeps the process id taken, so that the group can still be killed safely before it is reaped.
        if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0)
            return std::nullopt;
        return kill();
    }

    /// Ends the whole group and returns the child's status.
    int kill() {
        ::kill(-pid_, SIGKILL);
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = -1;
        if (!mark_.empty()) endMarked(mark_);
        return status;
    }

private:
    pid_t pid_;
    std::string mark_;
};

/// Cuts a stream of bytes into lines.
class Lines {
public:
    explicit Lines(const OnLine& onLine) : onLine_(onLine) {}

    void add(std::string_view bytes) {
        bytes_ += bytes.size();
        for (const char c : bytes) {
            if (c == '\n' || c == '\r')
                flush();
            else if (line_.size() < longestLine)
                line_ += c;
        }
    }
    void flush() {
        if (!line_.empty() && onLine_) onLine_(line_);
        line_.clear();
    }
    [[nodiscard]] std::uintmax_t bytes() const { return bytes_; } // so far

private:
    const OnLine& onLine_;
    std::string line_;
    std::uintmax_t bytes_ = 0;
};

bool readable(int fd, std::chrono::milliseconds wait) {
    pollfd watched{fd, POLLIN, 0};
    return ::poll(&watched, 1, static_cast<int>(wait.count())) > 0;
}

/// Passes on what is there; false at the end of the stream.
bool readSome(int fd, Lines& lines) {
    std::array<char, 8192> buffer{};
    const ssize_t count = read(fd, buffer.data(), buffer.size());
    if (count < 0) return errno == EINTR;
    lines.add({buffer.data(), static_cast<std::size_t>(count)});
    return count > 0;
}

Finished decoded(int status) {
    if (WIFSIGNALED(status)) return {.signal = WTERMSIG(status)};
    return {.exitCode = WEXITSTATUS(status)};
}

bool executable(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
}

} // namespace

std::optional<std::filesystem::path> findProgram(const std::filesystem::path& name) {
    if (name.has_parent_path()) return executable(name) ? std::optional(std::filesystem::absolute(name)) : std::nullopt;
    const char* variable = std::getenv("PATH");
    std::string_view rest = variable != nullptr ? variable : "/usr/bin:/bin";
    while (!rest.empty()) {
        const std::size_t colon = std::min(rest.find(':'), rest.size());
        const std::filesystem::path folder(rest.substr(0, colon));
        if (!folder.empty() && executable(folder / name)) return std::filesystem::absolute(folder / name);
        rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
    return std::nullopt;
}

std::vector<std::string> ownEnvironment() {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable) variables.emplace_back(*variable);
    return variables;
}

Finished runProcess(const Command& command, const OnLine& onLine) {
    const std::string mark = command.endsStrays ? newMark() : "";
    const Launch launch(command, mark);
    auto [output, outputEnd] = makePipe();
    Child child(start(launch, openNothing().get(), outputEnd.get(), outputEnd.get()), mark);
    outputEnd.close();

    Lines lines(onLine);
    const Clock::time_point end = Clock::now() + command.limit;
    std::optional<int> status;
    bool open = true;
    while (!status) {
        constexpr std::chrono::milliseconds tick{20};
        if (!open)
            ::poll(nullptr, 0, static_cast<int>(tick.count()));
        else if (readable(output.get(), tick))
            open = readSome(output.get(), lines);
        status = child.poll();
        if (!status && DeferredInterrupts::pending())
            throw Inconclusive(fmt::format("{} was stopped: the run was interrupted", command.program.filename().string()),
                               Failure::Transient);
        const bool late = Clock::now() >= end, flooded = command.outputLimit && lines.bytes() > *command.outputLimit;
        if (!status && (late || flooded)) {
            Finished stopped = decoded(child.kill());
            stopped.timedOut = late;
            stopped.flooded = flooded && !late;
            return stopped;
        }
    }
    const std::uintmax_t last = lines.bytes() + fullPipe; // a stray could fill it for ever
    while (open && lines.bytes() < last && readable(output.get(), {}))
        open = readSome(output.get(), lines); // what was still in the pipe
    lines.flush();
    return decoded(*status);
}

struct Dialogue::Running {
    std::string name;
    std::chrono::milliseconds limit;
    Descriptor input, output, errors;
    Child child;

    Running(const Command& command, Descriptor in, Descriptor out, Descriptor errorFile, pid_t pid)
        : name(command.program.filename().string()), limit(command.limit), input(std::move(in)), output(std::move(out)),
          errors(std::move(errorFile)), child(pid) {}

    [[noreturn]] void fail(const std::string& what) const {
        const std::string said = lastLine(errors.get());
        throw Inconclusive(fmt::format("{} {}{}{}", name, what, said.empty() ? "" : "; it said: ", said));
    }

    void send(std::string_view line) const {
        const std::string bytes = std::string(line) + '\n';
        for (std::size_t sent = 0; sent < bytes.size();) {
            const ssize_t count = ::send(input.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail("ended while it was being asked");
            sent += static_cast<std::size_t>(count);
        }
    }

    [[nodiscard]] std::string receive() const {
        const Clock::time_point end = Clock::now() + limit;
        std::string line;
        for (char c = 0;;) {
            if (!readable(output.get(), std::chrono::milliseconds(100))) {
                if (DeferredInterrupts::pending()) fail("was stopped: the run was interrupted");
                if (Clock::now() >= end) fail("did not answer in time");
                continue;
            }
            const ssize_t count = read(output.get(), &c, 1);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) fail("ended while it was being asked");
            if (line.size() == longestLine) fail("answered without end");
            if (c == '\n') return line;
            line += c;
        }
    }
};

Dialogue::Dialogue(const Command& command) {
    const Launch launch(command);
    auto [input, inputEnd] = makeSockets(); // writing to one whose other end is closed can be an error and no signal
    auto [output, outputEnd] = makePipe();
    Descriptor errors = openNameless(command.folder);
    const pid_t pid = start(launch, input.get(), outputEnd.get(), errors.get());
    running_ = std::make_unique<Running>(command, std::move(inputEnd), std::move(output), std::move(errors), pid);
}

Dialogue::~Dialogue() = default;
Dialogue::Dialogue(Dialogue&&) noexcept = default;
Dialogue& Dialogue::operator=(Dialogue&&) noexcept = default;

std::string Dialogue::ask(std::string_view line) {
    running_->send(line);
    return running_->receive();
}

} // namespace shadowbench
