#include "base/faults.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace shadowbench::faults {
namespace {

// By Point: too many files, a full disk, a broken one, too many processes or threads.
constexpr std::array errors{EMFILE, ENOSPC, EIO, EIO, EAGAIN, EAGAIN, EMFILE, ENOMEM};
static_assert(errors.size() == pointNames.size());

Plan* planOfEnvironment() {
    const char* file = std::getenv(variable);
    Plan* mapped = file != nullptr ? mapPlan(file) : nullptr;
    pid_t none = 0;
    if (mapped != nullptr) mapped->first.compare_exchange_strong(none, getpid());
    return mapped;
}

void log(bool isWanted, const char* name, const char* path, const char* from) {
    std::array<char, PATH_MAX> folder{};
    if (getcwd(folder.data(), folder.size()) == nullptr) folder[0] = '\0';
    std::array<char, std::size_t{4} * PATH_MAX> line{};
    const int printed =
        std::snprintf(line.data(), line.size(), "%s%s\t%s\t%s\t%s\n", isWanted ? "!" : "", name, folder.data(), path, from);
    const std::size_t length = std::min(static_cast<std::size_t>(printed), line.size());
    const std::size_t at = activePlan->logged.fetch_add(length);
    if (at + length <= activePlan->log.size()) std::memcpy(activePlan->log.data() + at, line.data(), length);
}

} // namespace

// In memory, as a reader of foreign files may have no further file open.
Plan* mapPlan(const char* file) {
    const int descriptor = open(file, O_RDWR | O_CLOEXEC);
    struct stat status {};
    void* memory = MAP_FAILED;
    if (descriptor >= 0 && fstat(descriptor, &status) == 0 && status.st_size == sizeof(Plan))
        memory = mmap(nullptr, sizeof(Plan), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (descriptor >= 0) close(descriptor);
    return memory == MAP_FAILED ? nullptr : static_cast<Plan*>(memory);
}

Plan* const activePlan = planOfEnvironment();

bool failsByPlan(Point point, const char* path, const char* from) {
    const Wanted& wanted = activePlan->wanted;
    const auto p = static_cast<std::size_t>(point);
    const std::uint64_t number = ++activePlan->counts.at(p), moment = ++activePlan->moments;
    const bool isSignalled = wanted.signal != 0 && moment == wanted.number;
    const bool fails = wanted.signal == 0 && point == wanted.point && wanted.number != 0 &&
                       (number == wanted.number || (wanted.lasting && number > wanted.number));
    log(isSignalled || fails, pointNames.at(p), path, from);
    if (isSignalled) {
        kill(wanted.toFirst ? activePlan->first.load() : getpid(), wanted.signal);
        usleep(10'000); // a process that ends by it does so before the call is made
    }
    if (fails) errno = errors.at(p);
    return fails;
}

} // namespace shadowbench::faults
