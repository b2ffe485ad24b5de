// Errors carry one sentence (what was being done, with what, and what to do) and the exit code that `main` returns.
#pragma once

#include <stdexcept>
#include <string>

namespace shadowbench {

/// The program's exit codes (docs/gate.md, "Exit codes").
enum class ExitCode {
    Pass = 0,
    Internal = 1,
    BadInput = 2,
    CostRegression = 3,
    AccuracyRegression = 4,
    Inconclusive = 5,
    Transient = 75, // EX_TEMPFAIL of <sysexits.h>; of parts of a run only
};

/// Whether the same command would fail again. A full disk, a killed tool and a lack of memory pass.
enum class Failure { Lasting, Transient };

/// The same of a system call's error number (errno).
Failure failureOf(int errorNumber);

class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& sentence, Failure failure = Failure::Lasting)
        : std::runtime_error(sentence), code_(code), failure_(failure) {}
    [[nodiscard]] ExitCode code() const { return code_; }
    [[nodiscard]] bool isTransient() const { return failure_ == Failure::Transient; }

private:
    ExitCode code_;
    Failure failure_;
};

/// The user's input or command is wrong.
struct BadInput : Error {
    explicit BadInput(const std::string& sentence) : Error(ExitCode::BadInput, sentence) {}
};

/// A tool or a control that the verdict needs is missing or failed: never silently green.
struct Inconclusive : Error {
    explicit Inconclusive(const std::string& sentence, Failure failure = Failure::Lasting)
        : Error(ExitCode::Inconclusive, sentence, failure) {}
};

/// Ours or the machine's fault: a full disk, a failed GL call, a broken invariant.
struct InternalError : Error {
    explicit InternalError(const std::string& sentence, Failure failure = Failure::Lasting)
        : Error(ExitCode::Internal, sentence, failure) {}
};

} // namespace shadowbench
