// Independent pieces of work spread over threads. What each piece writes must not depend on the others: then the result does
// not depend on the number of threads.
#pragma once

#include "base/progress.h"

#include <cstddef>
#include <functional>
#include <string_view>

namespace shadowbench {

/// How many threads this process may run at once, at least 1: all that the machine does, at most SHADOWBENCH_THREADS where
/// the environment has it; in one of several processes, its share of them. Every other count of threads or workers comes
/// from here, so that programs × processes × threads are no more than the machine runs.
int availableThreads();

/// From now on this process is one of `processes` that share what it had.
void shareThreads(int processes);

/// Calls `work(i)` once for each 0 ≤ i < count, in this order as threads become free; the calling thread is one of the
/// `threads` (≥ 1), of which there are fewer where the system has no more. Where a call throws, no more are begun, and the
/// first exception is thrown here when those under way have ended.
void inParallel(int count, int threads, const std::function<void(int)>& work);

/// The same, reporting the share that is done, with `what`, from the calling thread only.
void inParallel(int count, int threads, const Progress& progress, std::string_view what,
                const std::function<void(int)>& work);

/// Calls `work(begin, end)` for consecutive parts of 0 … count − 1 that are large enough to be worth a thread.
void inParallelParts(std::size_t count, int threads, const std::function<void(std::size_t, std::size_t)>& work);

} // namespace shadowbench
