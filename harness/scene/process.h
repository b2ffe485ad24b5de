// Runs one external program: no shell, an environment of our own, bounded in time, memory and files, no core dumps.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
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
    std::filesystem::path folder;                         // working directory, HOME and TMPDIR of the child
    std::chrono::milliseconds limit{60'000};              // wall clock; the child's whole process group is killed after it
    std::chrono::seconds cpuLimit{120};                   // of all its threads
    std::uintmax_t fileLimit = 64 << 20;                  // bytes, largest file the child may write
    std::uintmax_t memoryLimit = std::uintmax_t{4} << 30; // bytes of address space, more than is ever used of it
};

struct Finished {
    int exitCode = 0; // when signal is 0
    int signal = 0;   // that ended the child; 0 if it exited
    bool timedOut = false;
};

/// Called with each complete line (ended by '\n' or '\r', terminator removed) of the child's standard output and error.
using OnLine = std::function<void(std::string_view)>;

/// Runs to the end. The child has its own process group and dies with the calling thread; no member of the group is left
/// when this returns or `onLine` throws. Throws Inconclusive when the program cannot be started, and when the user
/// interrupts while a DeferredInterrupts is held.
Finished runProcess(const Command& command, const OnLine& onLine);

} // namespace shadowbench
