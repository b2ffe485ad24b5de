// Independent pieces of work on all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace shadowbench {

/// Calls `work` once with each of 0 … count − 1, several at once and in this order as cores become free. Where one throws,
/// no more are begun, and what the first one threw is thrown when those under way have ended.
void inParallel(std::size_t count, const std::function<void(std::size_t)>& work);

} // namespace shadowbench
