#include "base/marked_processes.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <poll.h>
#include <sstream>
#include <string>
#include <system_error>
#include <unistd.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

enum class Is { Marked, Another, Unknown };

/// The time since the system's start in the kernel's ticks, as processes have their own start in `stat`.
std::int64_t ticksNow() {
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    const std::int64_t ticks = sysconf(_SC_CLK_TCK);
    return now.tv_sec * ticks + now.tv_nsec * ticks / 1'000'000'000;
}

/// When a process started, in those ticks; 0 where it has ended.
std::int64_t startOf(const fs::path& process) {
    std::ifstream file(process / "stat");
    std::string text;
    std::getline(file, text);
    std::istringstream rest(text.substr(std::min(text.rfind(')') + 1, text.size()))); // the name before it may hold anything
    std::string field;
    for (int i = 3; i <= 22; ++i) rest >> field;
    return std::atoll(field.c_str());
}

/// A process that is being replaced by another program (exec) shows no variables for a moment.
Is what(const fs::path& process, const std::string& mark, std::int64_t since) {
    std::ifstream file(process / "environ", std::ios::binary);
    bool empty = true;
    for (std::string variable; std::getline(file, variable, '\0'); empty = false)
        if (variable == mark) return Is::Marked;
    std::error_code ignored;
    const fs::path program = fs::read_symlink(process / "exe", ignored); // none: it has ended, or is the kernel's
    return empty && !program.empty() && startOf(process) + 1 >= since ? Is::Unknown : Is::Another;
}

/// Kills what is marked; whether there was any, or something that may be.
bool endSome(const std::string& mark, std::int64_t since) {
    bool any = false;
    std::error_code ignored; // a process may end while it is looked at
    for (fs::directory_iterator i("/proc", ignored), end; i != end; i.increment(ignored)) {
        const pid_t process = std::atoi(i->path().filename().c_str());
        if (process <= 0 || process == getpid()) continue;
        const Is is = what(i->path(), mark, since);
        any = any || is != Is::Another;
        if (is == Is::Marked) ::kill(process, SIGKILL);
    }
    return any;
}

} // namespace

std::string newMark() {
    static std::atomic<int> count = 0;
    return fmt::format("SHADOWBENCH_CHILD={}-{}-{}", getpid(), ++count, ticksNow());
}

void endMarked(const std::string& mark) {
    const std::int64_t since = std::atoll(mark.c_str() + mark.rfind('-') + 1);
    constexpr int rounds = 200; // one that cannot be killed (it waits for a disk) must not hold us up for good
    int quiet = 0;              // rounds without any: a list of processes is read piece by piece and may miss a new one
    for (int round = 0; round < rounds && quiet < 2; ++round) {
        quiet = endSome(mark, since) ? 0 : quiet + 1;
        ::poll(nullptr, 0, 2);
    }
}

} // namespace shadowbench
