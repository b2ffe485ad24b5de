// What a person sees of long work: one line, redrawn on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace shadowbench {

class ProgressLine {
public:
    /// `total` steps under the heading `title`; nothing is shown when `quiet`.
    ProgressLine(std::string title, int total, bool quiet);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `done` whole steps, `share` of the current one in [0, 1], and what it is.
    void show(int done, double share, std::string_view what);

private:
    std::string title_;
    int total_;
    bool quiet_, terminal_;
    std::chrono::steady_clock::time_point start_, shown_;
    std::string lastWhat_;
    int lastDone_ = 0;
};

} // namespace shadowbench
