// Independent work items spread over threads; what each item writes must not depend on the others.
#pragma once

#include "base/progress.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace shadowbench::groundtruth {

/// Runs `work(i)` for 0 ≤ i < count on `threads` threads. Progress is called from the calling thread only. The first
/// exception thrown by an item ends the loop and is thrown again here.
template <typename Work>
void forEachInParallel(int count, int threads, const Progress& progress, std::string_view what, const Work& work) {
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
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(loop, false);
    loop(true);
    for (std::thread& other : others) other.join();
    if (failure) std::rethrow_exception(failure);
}

/// Runs `work(begin, end)` over consecutive parts of 0 … count − 1.
template <typename Work>
void forEachPart(std::size_t count, int threads, const Work& work) {
    constexpr std::size_t least = 1U << 13U; // items that are worth a thread
    const std::size_t parts = std::clamp<std::size_t>(count / least, 1, 8 * static_cast<std::size_t>(threads));
    if (threads == 1 || parts == 1) return work(std::size_t{0}, count);
    forEachInParallel(static_cast<int>(parts), threads, {}, {},
                      [&](int i) { work(count * i / parts, count * (i + 1) / parts); });
}

} // namespace shadowbench::groundtruth
