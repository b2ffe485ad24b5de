// Holds back an interrupt until what must not be left behind is gone.
#pragma once

namespace shadowbench {

/// While one is alive, the first SIGINT, SIGTERM or SIGHUP is only noted; it takes effect, in the way it would have before,
/// when the last one is destroyed. A second one of the same kind takes effect at once. Signals that were ignored before stay
/// so. May be nested; the process is expected to hold them on one thread at a time.
class DeferredInterrupts {
public:
    DeferredInterrupts();
    ~DeferredInterrupts();
    DeferredInterrupts(const DeferredInterrupts&) = delete;
    DeferredInterrupts& operator=(const DeferredInterrupts&) = delete;

    /// Whether one was noted: whoever waits for something should give up.
    [[nodiscard]] static bool pending();

    /// For a forked worker: it does not wait for what its parent holds, and second and later signals are held back as well.
    /// A worker may get SIGTERM repeatedly, from every thread of its parent that owns it; repeats are ignored.
    static void startAsWorker();
};

} // namespace shadowbench
