#include "base/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace shadowbench {
namespace {

constexpr int barWidth = 20;

std::string bar(double share) {
    const int filled = static_cast<int>(std::lround(share * barWidth));
    std::string text = "▐";
    for (int i = 0; i < barWidth; ++i) text += i < filled ? "█" : " ";
    return text + "▌";
}

std::string clock(double seconds) {
    const int whole = static_cast<int>(std::lround(seconds));
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

double seconds(std::chrono::steady_clock::duration time) { return std::chrono::duration<double>(time).count(); }

} // namespace

bool logLineIsDue(double elapsed, double last) { return elapsed - last >= std::clamp(elapsed / 2, 10.0, 60.0); }

ProgressLine::ProgressLine(std::string title, int total, bool quiet)
    : title_(std::move(title)), total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()),
      lastShown_(start_) {}

ProgressLine::~ProgressLine() {
    if (quiet_ || !terminal_) return;
    clear();
    fmt::print(stderr, "{:<24}{} {}/{}  {}\n", title_, bar(static_cast<double>(lastDone_) / std::max(1, total_)), lastDone_,
               total_, clock(seconds(Clock::now() - start_)));
}

void ProgressLine::show(int done, double share, std::string_view what) {
    lastDone_ = done;
    if (quiet_) return;
    const auto now = Clock::now();
    const double finished = (done + share) / std::max(1, total_);
    if (terminal_)
        draw(now, finished, what);
    else
        log(now, finished, what);
}

void ProgressLine::clear() {
    if (quiet_ || !terminal_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    lastShown_ = start_;
}

void ProgressLine::draw(Clock::time_point now, double finished, std::string_view what) {
    const bool first = lastShown_ == start_;
    if (!first && what == lastWhat_ && now - lastShown_ < std::chrono::milliseconds(100)) return;
    lastShown_ = now;
    lastWhat_ = what;
    fmt::print(stderr, "\r\033[K{:<24}{} {}/{}  {:<44.44}  {}", title_, bar(finished), lastDone_, total_, what,
               timeLeft(now, finished));
    std::fflush(stderr);
}

void ProgressLine::log(Clock::time_point now, double finished, std::string_view what) {
    if (what.empty() || !logLineIsDue(seconds(now - start_), seconds(lastShown_ - start_))) return;
    lastShown_ = now;
    const std::string left = timeLeft(now, finished);
    fmt::print(stderr, "{} {}/{}  {}  {}{}\n", title_, lastDone_, total_, what, clock(seconds(now - start_)),
               left.empty() ? "" : ", " + left);
}

std::string ProgressLine::timeLeft(Clock::time_point now, double finished) const {
    if (finished <= 0.05) return "";
    return fmt::format("about {} left", clock(seconds(now - start_) * (1 - finished) / finished));
}

} // namespace shadowbench
