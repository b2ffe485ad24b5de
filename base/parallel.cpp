#include "base/parallel.h"

#include "base/faults.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace shadowbench {

namespace {

int threadsAtStart() {
    const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const char* most = std::getenv("SHADOWBENCH_THREADS");
    return most == nullptr ? machine : std::clamp(std::atoi(most), 1, machine); // NOLINT(cert-err34-c): no number is 0
}

std::atomic<int>& threads() {
    static std::atomic<int> count{threadsAtStart()};
    return count;
}

} // namespace

int availableThreads() { return threads(); }

void shareThreads(int processes) { threads() = std::max(1, threads() / processes); }

void inParallel(int count, int threads, const std::function<void(int)>& work) { inParallel(count, threads, {}, {}, work); }

void inParallel(int count, int threads, const Progress& progress, std::string_view what,
                const std::function<void(int)>& work) {
    std::atomic<int> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto loop = [&](bool reports) {
        try {
            for (int i = next++; i < count; i = next++) {
                work(i);
                if (reports && progress) progress(static_cast<double>(i + 1) / count, what);
            }
        } catch (...) {
            const std::lock_guard lock(failing);
            if (!failure) failure = std::current_exception();
            next = count;
        }
    };
    {
        std::vector<std::jthread> others;
        try {
            for (int i = 1; i < std::min(threads, count); ++i) {
                if (faults::fails(faults::Point::Thread)) throw std::system_error(errno, std::generic_category());
                others.emplace_back(loop, false);
            }
        } catch (const std::system_error&) { // the system has no more threads: those there are do the work
        }
        loop(true);
    }
    if (failure) std::rethrow_exception(failure);
}

void inParallelParts(std::size_t count, int threads, const std::function<void(std::size_t, std::size_t)>& work) {
    constexpr std::size_t least = 1U << 13U; // items that are worth a thread
    const std::size_t parts = std::clamp<std::size_t>(count / least, 1, 8 * static_cast<std::size_t>(threads));
    if (threads == 1 || parts == 1) return work(std::size_t{0}, count);
    inParallel(static_cast<int>(parts), threads, [&](int i) {
        const auto part = static_cast<std::size_t>(i);
        work(count * part / parts, count * (part + 1) / parts);
    });
}

} // namespace shadowbench
