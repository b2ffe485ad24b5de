// What a person sees of long work: one line, redrawn on a terminal; elsewhere a plain line now and then.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace shadowbench {

/// Where there is no terminal: whether a line is due `elapsed` seconds after the start, if the last one was written `last`
/// seconds after it. Every ten seconds at first, the less often the longer the work takes, at last once a minute.
bool logLineIsDue(double elapsed, double last);

class ProgressLine {
public:
    /// `total` steps under the heading `title`; nothing is shown when `quiet`.
    ProgressLine(std::string title, int total, bool quiet);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `done` whole steps, `share` of the current one in [0, 1], and what it is.
    void show(int done, double share, std::string_view what);

    /// Takes the line off a terminal, for other text to be printed; the next `show` draws it again.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    void draw(Clock::time_point now, double finished, std::string_view what);
    void log(Clock::time_point now, double finished, std::string_view what);
    [[nodiscard]] std::string timeLeft(Clock::time_point now, double finished) const;

    std::string title_;
    int total_;
    bool quiet_, terminal_;
    Clock::time_point start_, lastShown_;
    std::string lastWhat_;
    int lastDone_ = 0;
};

} // namespace shadowbench
