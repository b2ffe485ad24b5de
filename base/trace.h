// Where the time of a program and of its worker processes goes: a file in Chrome's trace format, which Perfetto and
// chrome://tracing draw as a picture.
#pragma once

#include "base/descriptor.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

namespace shadowbench {

/// While it lives, this process and those that it forks append their spans to a file, a line each. A process that is killed
/// leaves out the spans it was in; a whole program that is killed leaves out the array's end, which readers do not need.
/// There is one at a time.
class Trace {
public:
    /// Replaces `file`; makes missing parent folders. Throws BadInput with the reason when that fails.
    explicit Trace(const std::filesystem::path& file);
    /// Appends the span of its own life, `run`, and ends the array.
    ~Trace();
    Trace(const Trace&) = delete;
    Trace& operator=(const Trace&) = delete;

private:
    Descriptor file_;
    std::chrono::steady_clock::time_point start_;
};

/// What this thread does from construction to destruction, with the time of a processor that it gets. Costs a branch where
/// there is no trace.
class Span {
public:
    /// `category` groups spans: setup, truth, frame, metrics … The texts must outlive the span; `scene` may be empty.
    Span(std::string_view category, std::string_view name, std::string_view scene = {});
    ~Span();
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

private:
    std::string_view category_, name_, scene_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::nanoseconds processorStart_{}; // of this thread
    bool traced_;
};

} // namespace shadowbench
