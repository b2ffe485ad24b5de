// How programs are started and ended: what base/process.cpp and base/confined/ have in common.
#pragma once

#include "base/descriptor.h"
#include "base/process.h"

#include <optional>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace shadowbench {

/// The reading and the writing end of a pipe that no program started later inherits. Throws Inconclusive when the system has
/// no more.
std::pair<Descriptor, Descriptor> makePipe();

/// /dev/null, for reading.
Descriptor openNothing();

/// Everything the child needs, laid out before the fork: afterwards only async-signal-safe calls are allowed.
struct Launch {
    const Command& command;
    std::vector<std::string> words, variables;
    std::vector<char*> argv, envp;

    /// `mark`: a variable by which what the child starts is known again; "": none.
    explicit Launch(const Command& c, const std::string& mark = "");

    /// In the child. Reports errno through `failure` when the program cannot be run.
    [[noreturn]] void exec(pid_t parent, int input, int output, int error, int failure) const;
};

/// Starts the program with these descriptors as its standard ones, in a process group of its own; returns once it runs.
/// Throws Inconclusive when it cannot be started.
pid_t start(const Launch& launch, int input, int output, int error);

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
    std::optional<int> poll();

    /// Tells the group to end (SIGTERM); returns when the child has, or after `grace`.
    void askToEnd(std::chrono::milliseconds grace);

    /// Ends the whole group and returns the child's status.
    int kill();

private:
    pid_t pid_;
    std::string mark_;
};

/// What a status of waitpid() says.
Finished decoded(int status);

} // namespace shadowbench
