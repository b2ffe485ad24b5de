// Work counters: what a frame asks of the GPU, independent of how fast this machine is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace shadowbench::gl {

/// Counted by the wrappers of this folder as they submit work and allocate memory.
struct Tally {
    std::uint64_t draws = 0;  // draw calls
    std::uint64_t passes = 0; // framebuffers bound for drawing
    std::uint64_t bytes = 0;  // texture and buffer bytes alive now
    std::uint64_t peak = 0;   // the most of them since `watchPeak`

    void allocate(std::uint64_t more) {
        bytes += more;
        peak = std::max(peak, bytes);
    }
    void release(std::uint64_t fewer) { bytes -= fewer; }
    void watchPeak() { peak = bytes; }
};

struct WorkCount {
    std::uint64_t fragments = 0;  // fragment shader invocations
    std::uint64_t vertices = 0;   // vertices submitted to the input assembler
    std::uint64_t primitives = 0; // primitives submitted to the input assembler
    std::uint64_t draws = 0;
    std::uint64_t passes = 0;
};

/// Counts the work between construction and `finish`, with pipeline-statistics queries. One at a time.
class WorkMeter {
public:
    WorkMeter();
    ~WorkMeter();
    WorkMeter(const WorkMeter&) = delete;
    WorkMeter& operator=(const WorkMeter&) = delete;

    WorkCount finish();

private:
    unsigned queries_[3];
    bool running_ = true;
    Tally start_;
    void end();
};

/// Counts the fragments that pass depth and stencil test and are not discarded, between construction and `finish`. One at a
/// time.
class FragmentMeter {
public:
    FragmentMeter();
    ~FragmentMeter();
    FragmentMeter(const FragmentMeter&) = delete;
    FragmentMeter& operator=(const FragmentMeter&) = delete;

    std::uint64_t finish();

private:
    unsigned query_ = 0;
    bool running_ = true;
    void end();
};

/// Moments on the clock of the graphics processor, each when what was submitted before it is done: they do not count what
/// the program does before it submits. Only where `isSupported`.
class TimeStamps {
public:
    TimeStamps() = default;
    ~TimeStamps();
    TimeStamps(const TimeStamps&) = delete;
    TimeStamps& operator=(const TimeStamps&) = delete;

    void mark();

    /// Milliseconds from each mark to the next one. Waits until the last is reached.
    [[nodiscard]] std::vector<double> intervals() const;

    /// Whether the driver has that clock.
    static bool isSupported();

private:
    std::vector<unsigned> queries_;
};

} // namespace shadowbench::gl
