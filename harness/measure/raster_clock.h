// The clock that a frame's work is timed by.
#pragma once

namespace shadowbench::timing {

/// Milliseconds of this thread's processor time where the rasteriser draws on it, so that other programs do not count; else
/// of wall time. Needs a GL context; what has been submitted counts once it is finished (gl::Context::finish).
double rasterMilliseconds();

} // namespace shadowbench::timing
