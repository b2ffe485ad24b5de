#include "harness/measure/raster_clock.h"

#include "techniques/gl/context.h"

#include <ctime>

namespace shadowbench::timing {

double rasterMilliseconds() {
    const gl::ContextInfo& info = gl::Context::current().info();
    const clockid_t clock = info.software && info.rasterThreads == 0 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

PartTimer::PartTimer() : before_(gl::Context::current().tally()) {
    // Mesa's rasteriser in software answers, but with the time of day at which it came to the query.
    if (!gl::Context::current().info().software && gl::TimeStamps::isSupported()) onDevice_.emplace().mark();
    start_ = rasterMilliseconds();
}

double PartTimer::milliseconds() {
    gl::Context& context = gl::Context::current();
    const gl::Tally now = context.tally();
    const bool drew = now.draws != before_.draws || now.passes != before_.passes;
    if (onDevice_ && drew) {
        onDevice_->mark();
        return onDevice_->intervals().front();
    }
    context.finish();
    return rasterMilliseconds() - start_;
}

} // namespace shadowbench::timing
