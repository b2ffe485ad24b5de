#include "base/folder_lock.h"

#include "base/error.h"
#include "base/faults.h"
#include "base/files.h"
#include "base/interrupts.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds pause{20}; // between two looks whether the lock is free
constexpr int mostAttempts = 100;              // to lock a folder that others make and remove

void waitFor(int descriptor, const fs::path& folder, const std::function<void()>& onWait) {
    const auto taken = [&] { return flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; };
    if (taken()) return;
    if (onWait) onWait();
    // Not a call that blocks: it would go on after an interrupt that is only noted.
    while (!taken()) {
        if (DeferredInterrupts::pending())
            throw Inconclusive(fmt::format("waiting for another process that uses {} was interrupted", folder.string()),
                               Failure::Transient);
        std::this_thread::sleep_for(pause);
    }
}

} // namespace

FolderLock::FolderLock(const fs::path& folder, const std::function<void()>& onWait) {
    for (int attempt = 0; attempt < mostAttempts; ++attempt) {
        std::error_code failed;
        if (std::vector<fs::path> made = makeFolders(folder, failed); !made.empty()) made_ = std::move(made);
        const bool fails = !failed && faults::fails(faults::Point::Open, folder.c_str());
        if (!failed) folder_ = Descriptor(fails ? -1 : open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        const int error = failed ? failed.value() : folder_.get() < 0 ? errno : 0;
        if (error == ENOENT) continue; // another process has removed it meanwhile
        if (error != 0) return;
        waitFor(folder_.get(), folder, onWait);
        if (isStillNamed(folder_.get(), folder)) return; // else its holder has removed it, because it was empty
    }
}

FolderLock::~FolderLock() {
    for (const fs::path& folder : made_)
        if (::rmdir(folder.c_str()) != 0) break; // something is in it
}

OutputLock::OutputLock(const fs::path& folder)
    : FolderLock(folder,
                 [&] { fmt::print(stderr, "waiting for another shadowbench that writes into {}\n", folder.string()); }) {}

} // namespace shadowbench
