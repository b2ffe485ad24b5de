#include "base/interrupts.h"

#include <array>
#include <atomic>
#include <csignal>
#include <mutex>
#include <utility>

namespace shadowbench {
namespace {

constexpr std::array interrupts{SIGINT, SIGTERM, SIGHUP};

// A signal handler can reach nothing but statics. It runs in whichever thread the signal comes to: not in the one that asks.
std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free); // as a handler needs

bool holdsBackAll = false;

struct Before {
    int holders = 0;
    std::array<struct sigaction, interrupts.size()> actions{};
};
std::mutex mutex;
Before before;

void note(int signal) { noted = signal; }

bool isIgnored(const struct sigaction& action) {
    return (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == SIG_IGN;
}

void hold() {
    struct sigaction noting {};
    noting.sa_handler = note;
    // Reset: so that the second one is not held back.
    noting.sa_flags = static_cast<int>(holdsBackAll ? SA_RESTART : SA_RESTART | SA_RESETHAND);
    sigemptyset(&noting.sa_mask);
    for (std::size_t i = 0; i < interrupts.size(); ++i) {
        sigaction(interrupts[i], nullptr, &before.actions[i]);
        if (!isIgnored(before.actions[i])) sigaction(interrupts[i], &noting, nullptr);
    }
}

void release() {
    for (std::size_t i = 0; i < interrupts.size(); ++i) sigaction(interrupts[i], &before.actions[i], nullptr);
    const int signal = noted.exchange(0);
    if (signal != 0) std::raise(signal);
}

} // namespace

DeferredInterrupts::DeferredInterrupts() {
    const std::scoped_lock lock(mutex);
    if (before.holders++ == 0) hold();
}

DeferredInterrupts::~DeferredInterrupts() {
    const std::scoped_lock lock(mutex);
    if (before.holders > 0 && --before.holders == 0) release(); // none: a worker destroys what was held before it began
}

bool DeferredInterrupts::pending() { return noted != 0; }

void DeferredInterrupts::startAsWorker() {
    const std::scoped_lock lock(mutex);
    holdsBackAll = true;
    if (std::exchange(before.holders, 0) > 0) release(); // with what was noted before: then there is nothing to begin
}

} // namespace shadowbench
