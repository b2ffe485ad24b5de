// Independent work items spread over threads; what each item writes must not depend on the others.
#pragma once

#include "harness/scene/progress.h"

#include <atomic>
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

} // namespace shadowbench::groundtruth
