// How much memory there is for this process, so that work that cannot fit ends before it begins.
#pragma once

#include <cstdint>
#include <string>

namespace shadowbench {

/// Bytes: the least of the machine's memory and swap, the limits of the control groups that this process is in, its limit on
/// addresses, and Limit::MemoryMib. Not what happens to be free: the same input is refused or not on each day.
std::uint64_t memoryThere();

/// "1.4 GiB", "300 MiB".
std::string inBytes(std::uint64_t bytes);

} // namespace shadowbench
