#include "base/memory.h"

#include "base/limits.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <sys/resource.h>
#include <sys/sysinfo.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t ofTheMachine() {
    struct sysinfo info {};
    if (sysinfo(&info) != 0) return unlimited;
    return (std::uint64_t{info.totalram} + info.totalswap) * info.mem_unit;
}

/// The number in a file of a control group; "max", or no such file: no limit.
std::uint64_t numberIn(const fs::path& file) {
    std::ifstream stream(file);
    std::uint64_t number = 0;
    return stream >> number ? number : unlimited;
}

/// Of the group that this process is in and, in a container, of the root that it sees; versions 1 and 2.
std::uint64_t ofControlGroups() {
    const fs::path root("/sys/fs/cgroup");
    std::uint64_t least = std::min(numberIn(root / "memory.max"), numberIn(root / "memory/memory.limit_in_bytes"));
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) { // "4:memory:/path", or "0::/path"
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string kind = line.substr(first + 1, second - first - 1);
        const fs::path path = fs::path(line.substr(second + 1)).relative_path();
        if (kind.empty()) least = std::min(least, numberIn(root / path / "memory.max"));
        if (kind == "memory") least = std::min(least, numberIn(root / "memory" / path / "memory.limit_in_bytes"));
    }
    return least;
}

std::uint64_t ofAddresses() {
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ? unlimited : limit.rlim_cur;
}

} // namespace

std::uint64_t memoryThere() {
    return std::min({ofTheMachine(), ofControlGroups(), ofAddresses(), limitOf(Limit::MemoryMib) << 20U});
}

std::string inBytes(std::uint64_t bytes) {
    constexpr double mib = 1 << 20, gib = 1 << 30;
    const auto size = static_cast<double>(bytes);
    return size < gib ? fmt::format("{:.0f} MiB", size / mib) : fmt::format("{:.1f} GiB", size / gib);
}

} // namespace shadowbench
