// Errors carry one sentence (what was being done, with what, and what to do) and the exit code that `main` returns.
#pragma once

#include <stdexcept>
#include <string>

namespace shadowbench {

/// The program's exit codes (README, "Exit codes").
enum class ExitCode {
    Pass = 0,
    Internal = 1,
    BadInput = 2,
    CostRegression = 3,
    AccuracyRegression = 4,
    Inconclusive = 5,
};

class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
    [[nodiscard]] ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

/// The user's input or command is wrong.
struct BadInput : Error {
    explicit BadInput(const std::string& sentence) : Error(ExitCode::BadInput, sentence) {}
};

/// A tool or a control that the verdict needs is missing or failed: never silently green.
struct Inconclusive : Error {
    explicit Inconclusive(const std::string& sentence) : Error(ExitCode::Inconclusive, sentence) {}
};

/// Ours or the machine's fault: a full disk, a failed GL call, a broken invariant.
struct InternalError : Error {
    explicit InternalError(const std::string& sentence) : Error(ExitCode::Internal, sentence) {}
};

} // namespace shadowbench
