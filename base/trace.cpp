#include "base/trace.h"

#include "base/error.h"
#include "base/faults.h"
#include "base/one_line.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace shadowbench {
namespace {

using Clock = std::chrono::steady_clock; // one for all processes of the machine

// Of the one trace that this process writes; -1: of none. Spans stand where no function could be handed a trace.
std::atomic<int> traceFile = -1;

/// As text of JSON, without the quotation marks around it.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : onOneLine(std::string(text))) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

double microseconds(Clock::duration time) { return std::chrono::duration<double, std::micro>(time).count(); }

std::chrono::nanoseconds processorTime() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

/// An event without its end, to which more may be appended.
std::string eventOf(std::string_view category, std::string_view name, Clock::time_point start) {
    return fmt::format(R"({{"name":"{}","cat":"{}","ph":"X","ts":{:.3f},"dur":{:.3f},"pid":{},"tid":{})", escaped(name),
                       category, microseconds(start.time_since_epoch()), microseconds(Clock::now() - start), getpid(),
                       gettid());
}

/// In one call, and the file is open for appending: lines of several processes do not mix. A trace that cannot be written
/// ends in this process, and the run goes on.
void append(const std::string& text) {
    const int file = traceFile;
    if (!faults::fails(faults::Point::Write) && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()))
        return;
    fmt::print(stderr, "the trace is not complete: writing it failed: {}\n", std::strerror(errno));
    traceFile = -1;
}

Descriptor openTrace(const std::filesystem::path& file) {
    std::error_code failed;
    std::filesystem::create_directories(file.parent_path(), failed); // what is not made is not opened
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC;
    Descriptor opened(faults::fails(faults::Point::Open, file.c_str()) ? -1 : ::open(file.c_str(), flags, 0644));
    if (opened.get() < 0)
        throw BadInput(
            fmt::format("cannot write the trace {}: {}; choose another place", file.string(), std::strerror(errno)));
    return opened;
}

} // namespace

Trace::Trace(const std::filesystem::path& file) : file_(openTrace(file)), start_(Clock::now()) {
    traceFile = file_.get();
    append("[\n");
}

Trace::~Trace() {
    if (traceFile >= 0) append(eventOf("run", "run", start_) + "}\n]\n");
    traceFile = -1;
}

Span::Span(std::string_view category, std::string_view name, std::string_view scene)
    : category_(category), name_(name), scene_(scene), traced_(traceFile >= 0) {
    if (!traced_) return;
    start_ = Clock::now();
    processorStart_ = processorTime();
}

Span::~Span() {
    if (!traced_ || traceFile < 0) return;
    std::string event = eventOf(category_, name_, start_);
    event += fmt::format(R"(,"tdur":{:.3f})", microseconds(processorTime() - processorStart_));
    if (!scene_.empty()) event += fmt::format(R"(,"args":{{"scene":"{}"}})", escaped(scene_));
    append(event + "},\n");
}

} // namespace shadowbench
