// Work that several processes share: for what keeps one state per process, as a GL context does, and so cannot be spread
// over threads (base/parallel.h).
#pragma once

#include "base/progress.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace shadowbench {

struct SharedWork {
    std::size_t items = 0;

    // In a worker:
    /// Does item i < items and returns what `finished` is given. A worker keeps what it made for earlier items; the items
    /// that it is given rise. What it throws ends the worker.
    std::function<std::string(std::size_t item, const Progress& progress)> work;
    /// Gives back what it has kept, after the last item; may be empty.
    std::function<void()> leave = {};

    // In this process, one call at a time:
    std::function<void(std::size_t item, double done, std::string_view what)> progress = {}; // of `work`; may be empty
    std::function<void(std::size_t item, std::string answer)> finished;
    /// Its worker "was killed by signal 9", "failed: …", "took longer than 120 s and was ended" (see sayDoing).
    std::function<void(std::size_t item, const std::string& how)> lost;
    /// After which the worker of an item is ended; 0: never. May be empty.
    std::function<std::chrono::seconds(std::size_t item)> limit = {};
};

/// Does every item once, in rising order as workers become free, and returns when all are finished or lost. The workers are
/// copies of this process as it is when they are started (fork), which therefore must not hold a GL context and must run no
/// other thread; they end with it, and share its threads (base/parallel.h). One that has ended before its time is replaced.
/// Throws InternalError when none can be started, and what `finished` and `lost` throw.
void shareAmongProcesses(int workers, const SharedWork& work);

/// In a worker: says what it does from now on, for `lost` to be told of one that is ended for its limit: "took longer than
/// 120 s in `what` and was ended". Whether this process is a worker; elsewhere it says nothing.
bool sayDoing(std::string_view what);

/// In a worker: has it lost as one that failed with `sentence`. Whether it could be sent; elsewhere it cannot. May be called
/// by a signal's handler, which ends the worker then.
bool sendFailure(std::string_view sentence);

/// Calls `check` in such a process and throws here what it throws, as an Error of the same code and sentence: for questions
/// that take what this process must not have made before it forks. Throws InternalError when the process is lost, as it is
/// after `limit`; 0: never.
void checkInOwnProcess(const std::function<void()>& check, std::chrono::seconds limit = std::chrono::seconds(0));

} // namespace shadowbench
