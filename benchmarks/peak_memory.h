// Peak memory of a piece of work, measured in a process of its own.
#pragma once

#include <cstddef>
#include <functional>

namespace shadowbench::benchmarks {

/// Runs `work` in a forked child and returns the child's greatest resident set in bytes. What is resident in the calling
/// process counts too: call it while that is small. InternalError if the child fails.
std::size_t peakMemory(const std::function<void()>& work);

} // namespace shadowbench::benchmarks
