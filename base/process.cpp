#include "base/process.h"

#include "base/descriptor.h"
#include "base/error.h"
#include "base/faults.h"
#include "base/interrupts.h"
#include "base/launch.h"
#include "base/marked_processes.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace shadowbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t longestLine = 4096;    // a child that never ends a line must not fill our memory
constexpr std::uintmax_t fullPipe = 1 << 20; // bytes, the most that a pipe holds

std::string reason(int error) { return std::generic_category().message(error); }

/// A file in `folder` that is gone when nobody has it open.
Descriptor openNameless(const std::filesystem::path& folder) {
    const bool fails = faults::fails(faults::Point::Open, folder.c_str());
    Descriptor file(fails ? -1 : open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR));
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
        if (!status && DeferredInterrupts::pending()) {
            if (command.grace.count() > 0) child.askToEnd(command.grace);
            throw Inconclusive(fmt::format("{} was stopped: the run was interrupted", command.program.filename().string()),
                               Failure::Transient);
        }
        const bool late = Clock::now() >= end, flooded = command.outputLimit && lines.bytes() > *command.outputLimit;
        const bool unwanted = !status && command.stops && command.stops();
        if (!status && (late || flooded || unwanted)) {
            Finished stopped = decoded(child.kill());
            stopped.timedOut = late;
            stopped.flooded = flooded && !late;
            stopped.stopped = unwanted && !late && !flooded;
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
