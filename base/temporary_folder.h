// A private folder that is gone when its owner is.
#pragma once

#include "base/interrupts.h"

#include <filesystem>

namespace shadowbench {

/// A new folder under the system's temporary folder ($TMPDIR, else /tmp) that only this user can read. Removed, with all it
/// holds, by the destructor; an interrupt waits for that. A process that is killed cannot, so each new folder first removes
/// those whose owners are dead: an owner holds a lock on its folder, which ends with it. Throws Inconclusive when it cannot
/// be made.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    DeferredInterrupts deferred_; // destroyed after the folder
    std::filesystem::path path_;
    int lock_ = -1; // file descriptor of the folder, which holds the lock
};

} // namespace shadowbench
