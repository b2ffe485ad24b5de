// The clock that a frame's work is timed by.
#pragma once

#include "techniques/gl/counters.h"

#include <optional>

namespace shadowbench::timing {

/// Milliseconds of this thread's processor time where the rasteriser draws on it, so that other programs do not count; else
/// of wall time. Needs a GL context; what has been submitted counts once it is finished (gl::Context::finish).
double rasterMilliseconds();

/// Times a part of a frame, between construction and `milliseconds`: what it draws on a graphics processor by that one's own
/// clock, where the driver has it (GL_TIMESTAMP), anything else by rasterMilliseconds. Construct it with nothing left to
/// finish.
class PartTimer {
public:
    PartTimer();

    /// Waits until what was submitted is done. Once.
    double milliseconds();

private:
    std::optional<gl::TimeStamps> onDevice_;
    gl::Tally before_;
    double start_;
};

} // namespace shadowbench::timing
