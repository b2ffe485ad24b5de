// What a process gives up before it looks at a file of other people: it can then compute, read what is open, write to the
// socket that it was given, and end; nothing else, whatever the file makes of it.
#pragma once

#include <cstdint>
#include <string>

namespace shadowbench {

/// A build with AddressSanitizer or ThreadSanitizer reserves terabytes, and works with threads and files of its own.
bool hasSanitizer();

/// What held a reader. Limits hold everywhere: no new descriptor, no byte into a file, no core dump, bounded memory and
/// time.
struct Protections {
    bool systemCalls = false; // a filter of system calls (seccomp); any other than those of reading ends the process
    int landlock = 0;         // version of the kernel's Landlock that denies it all files and networks; 0: there is none

    [[nodiscard]] std::uint64_t packed() const {
        return (systemCalls ? 1U : 0U) | static_cast<std::uint64_t>(landlock) << 1U;
    }
    static Protections unpacked(std::uint64_t number) {
        return {(number & 1U) != 0, static_cast<int>(number >> 1U & 0xFFU)};
    }
    /// "limits, a filter of system calls, Landlock 6".
    [[nodiscard]] std::string inWords() const;
};

/// Confines the calling process, for good; `socket` is the one descriptor that it may send to. Whatever the system has of
/// the protections is used, and what it lacks is left out. `memory`: bytes of address space; `seconds` of processor time.
Protections confineThisProcess(int socket, std::uint64_t memory, std::uint64_t seconds);

} // namespace shadowbench
