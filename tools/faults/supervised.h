// Runs a program and decides about each system call of it, and of all that it starts, that concerns files or processes: it
// goes on, it fails, or a process gets a signal at that moment. So a fault has a number instead of a time, and comes again.
//
// By seccomp's user notifications (Linux 5.5). strace, which can fail the k-th call, too, counts in each thread by itself
// and cannot leave out what the loader opens; libfiu fails calls by chance, and only those that go through the linker: none
// that the C library makes within fopen.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace shadowbench::faults {

enum class Kind { Open, Write, Rename, Fsync, Fork, Thread, Pipe };

std::string_view name(Kind kind);

/// A system call that is about to be made.
struct Call {
    Kind kind = Kind::Open;
    pid_t process = 0;
    bool byProgram = false; // by the program itself, not by a tool that it has started
    std::string path;       // absolute, of what is opened, written, flushed, or the new name; of a pipe "pipe:[7]"; or ""
    std::string from;       // the old name of a rename
    int descriptor = -1;    // that is written
    bool creates = false;   // opened to be written
};

/// What becomes of it: with `error` (errno) it fails; `signal` is sent to `whom` before it goes on.
struct Decision {
    int error = 0;
    int signal = 0;
    pid_t whom = 0;
};

using Decide = std::function<Decision(const Call& call, pid_t root)>;

struct Job {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::filesystem::path folder;       // in which it starts
    std::vector<std::string> variables; // its environment, as NAME=value
    std::chrono::seconds limit{180};
    std::chrono::seconds patience{20}; // for what it started to end after it
};

struct Ended {
    int code = 0; // or 128 + signal
    std::string output, errors;
    bool late = false;     // it was killed after its limit
    int strays = 0;        // processes that outlived it and the patience, and were killed
    std::size_t calls = 0; // that were decided about
};

/// Whether this system lets a program be supervised.
bool canSupervise();

/// Runs to the end, of everything that was started. Throws Inconclusive where it cannot. This process becomes the parent of
/// orphans meanwhile, and should have no other children.
Ended supervise(const Job& job, const Decide& decide);

} // namespace shadowbench::faults
