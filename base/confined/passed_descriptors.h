// Open files and sockets, passed from one process to another.
#pragma once

#include "base/descriptor.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace shadowbench {

/// Of descriptors passed at once; the kernel's own bound is 253.
constexpr std::size_t kMostPassed = 64;

/// Sends `number` over the Unix-domain socket, with copies of at most kMostPassed descriptors. Whether it went through.
bool passDescriptors(int socket, std::uint64_t number, std::span<const int> descriptors);

/// Waits for such a number; nothing at the end of the stream.
std::optional<std::pair<std::uint64_t, std::vector<Descriptor>>> takeDescriptors(int socket);

} // namespace shadowbench
