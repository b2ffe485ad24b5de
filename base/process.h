// Runs one external program: no shell, an environment of our own, bounded in time, memory and files, no core dumps.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

/// The executable that `name` means: itself when it holds a slash, else the first match on PATH; nothing if there is none.
std::optional<std::filesystem::path> findProgram(const std::filesystem::path& name);

struct Command {
    std::filesystem::path program; // as findProgram returns it
    std::vector<std::string> arguments;
    std::filesystem::path folder;            // working directory, HOME and TMPDIR of the child
    std::chrono::milliseconds limit{60'000}; // wall clock; the child's whole process group is killed after it
    // Of all its threads. A process under any such limit reads its own CPU time from a clock of some milliseconds: the
    // kernel then takes it from what it has last added up.
    std::optional<std::chrono::seconds> cpuLimit{120};
    std::uintmax_t fileLimit = 64 << 20; // bytes, largest file the child may write
    // Bytes of address space, more than is ever used of it; none: some programs reserve terabytes.
    std::optional<std::uintmax_t> memoryLimit = std::uintmax_t{4} << 30;
    std::optional<std::uintmax_t> openFiles = 64; // its own, its libraries' and a few of its work; none: as many as we may
    std::optional<int> cpu = {};                  // the only one it may run on
    // All variables that the child sees, as NAME=value; none: HOME and TMPDIR, a language of C, and our PATH.
    std::optional<std::vector<std::string>> environment = {};
    std::vector<std::string> inherited = {};        // names of further variables that it has as this process has them
    std::optional<int> threads = {};                // of our own program: SHADOWBENCH_THREADS (base/parallel.h)
    std::optional<std::uintmax_t> outputLimit = {}; // bytes of standard output and error; the group is killed after them
    // When the user interrupts, the group is told to end (SIGTERM) and has this long to leave nothing half done.
    std::chrono::milliseconds grace{0};
    bool endsStrays = false; // processes that left the group (setsid, daemons) are killed as well, as soon as the child ends
    std::function<bool()> stops =
        {}; // asked again and again: whether nobody wants the child any more; its group is then killed
};

/// The variables of this process, for Command::environment.
std::vector<std::string> ownEnvironment();

struct Finished {
    int exitCode = 0; // when signal is 0
    int signal = 0;   // that ended the child; 0 if it exited
    bool timedOut = false;
    bool flooded = false; // wrote more than Command::outputLimit
    bool stopped = false; // since Command::stops said so
};

/// Called with each complete line but empty ones (ended by '\n' or '\r', which is removed) of the child's two outputs.
using OnLine = std::function<void(std::string_view)>;

/// Runs to the end. The child has its own process group and dies with the calling thread; no member of the group is left
/// when this returns or `onLine` throws. Throws Inconclusive when the program cannot be started, and when the user
/// interrupts while a DeferredInterrupts is held.
Finished runProcess(const Command& command, const OnLine& onLine);

/// A program that runs on and answers each line it is sent with a line. It dies with the object or the thread that made it,
/// however that ends.
class Dialogue {
public:
    /// Starts it. `command.limit` bounds the wait for each answer. Throws Inconclusive when it cannot be started.
    explicit Dialogue(const Command& command);
    ~Dialogue();
    Dialogue(Dialogue&&) noexcept;
    Dialogue& operator=(Dialogue&&) noexcept;

    /// Sends `line` (without its end) and waits for the answer. Throws Inconclusive, with the last line of the program's
    /// standard error, when it has ended, is late, or the user interrupts while a DeferredInterrupts is held.
    std::string ask(std::string_view line);

private:
    struct Running;
    std::unique_ptr<Running> running_;
};

} // namespace shadowbench
