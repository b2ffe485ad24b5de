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

} // namespace

ProgressLine::ProgressLine(std::string title, int total, bool quiet)
    : title_(std::move(title)), total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
    if (quiet_) return;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (terminal_) std::fputs("\r\033[K", stderr);
    fmt::print(stderr, "{:<24}{} {}/{}  {}\n", title_, bar(static_cast<double>(lastDone_) / std::max(1, total_)), lastDone_,
               total_, clock(elapsed));
}

void ProgressLine::show(int done, double share, std::string_view what) {
    lastDone_ = done;
    if (quiet_) return;
    const auto now = std::chrono::steady_clock::now();
    const bool news = what != lastWhat_;
    if (!terminal_) {
        if (news && !what.empty()) fmt::print(stderr, "{} {}/{}  {}\n", title_, done, total_, what);
        lastWhat_ = what;
        return;
    }
    if (!news && now - shown_ < std::chrono::milliseconds(100)) return;
    shown_ = now;
    lastWhat_ = what;
    const double finished = (done + share) / std::max(1, total_);
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const std::string left = finished > 0.05 ? fmt::format("about {} left", clock(elapsed * (1 - finished) / finished)) : "";
    fmt::print(stderr, "\r\033[K{:<24}{} {}/{}  {:<44.44}  {}", title_, bar(finished), done, total_, what, left);
    std::fflush(stderr);
}

} // namespace shadowbench
