#include "harness/measure/raster_clock.h"

#include "techniques/gl/context.h"

#include <ctime>

namespace shadowbench::timing {

double rasterMilliseconds() {
    const clockid_t clock = gl::Context::current().info().rasterThreads == 0 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

} // namespace shadowbench::timing
