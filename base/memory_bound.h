// A bound on the memory that a library may take which takes what it is asked for.
#pragma once

#include <cstdint>
#include <string>

namespace shadowbench {

/// As long as it lives, this process gets at most `bytes` more memory of its own. A library that finds none, or that
/// recurses until there is no stack, ends the process by a signal: then a worker is lost as one that failed with `sentence`
/// (base/worker_processes.h), and any other process says it on standard error and ends with ExitCode::BadInput. What
/// allocates in C++ throws std::bad_alloc. One lives at a time. Does nothing in a build with sanitizers, which have bounds
/// of their own.
class MemoryBound {
public:
    MemoryBound(std::uint64_t bytes, const std::string& sentence);
    ~MemoryBound();
    MemoryBound(const MemoryBound&) = delete;
    MemoryBound& operator=(const MemoryBound&) = delete;
};

} // namespace shadowbench
