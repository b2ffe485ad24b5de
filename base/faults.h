// Fault points: before each call to the system that can fail, tools/faults can let it fail, or send a signal. Without a
// plan, which a variable of the environment names, a point is one branch. SQLite's tests do the same in its layer of files.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <sys/types.h>

namespace shadowbench::faults {

enum class Point { Open, Write, Rename, Fsync, Fork, Thread, Pipe, Allocation }; // the last by tools/faults/failing_new.cpp
constexpr std::array pointNames{"open", "write", "rename", "fsync", "fork", "thread", "pipe", "allocation"};
using Counts = std::array<std::uint64_t, pointNames.size()>;

/// The call that fails, or the moment of a signal. Numbers start at 1 and count in all processes of a run; 0 is none.
struct Wanted {
    Point point = Point::Open;
    std::uint64_t number = 0; // of the point's calls; with a signal, of all points but allocations
    bool lasting = false;     // and all calls after it
    int signal = 0;
    bool toFirst = false; // the signal goes to the process that began first; else to the one that is at the point
};

/// A file that all processes of a run map. Of zeros, it only counts.
struct Plan {
    Wanted wanted;
    std::array<std::atomic<std::uint64_t>, pointNames.size()> counts{};
    std::atomic<std::uint64_t> moments = 0; // points that a signal can be sent at
    std::atomic<pid_t> first = 0;
    std::atomic<std::size_t> logged = 0;
    // A line for each point but allocations: "!" where it is the wanted one, its name, the folder that its process is in,
    // the path, and the former path of a rename, with a tab between.
    std::array<char, std::size_t{1} << 22U> log{};
};

constexpr const char* variable = "SHADOWBENCH_FAULT_PLAN"; // the plan's file; base/launch.h hands it on to programs

/// Null where there is no such file, or it has another size.
Plan* mapPlan(const char* file);

extern Plan* const activePlan; // null: no call fails
bool failsByPlan(Point point, const char* path, const char* from);

/// Whether the call that comes next is to fail; then errno says why.
inline bool fails(Point point, const char* path = "", const char* from = "") {
    return activePlan != nullptr && failsByPlan(point, path, from);
}

} // namespace shadowbench::faults
