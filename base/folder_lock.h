// Keeps processes that write into one folder apart.
#pragma once

#include "base/descriptor.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace shadowbench {

/// Held by the one process that may write what belongs together in `folder`, or compute what is kept there; another one
/// waits until it is gone, however it ends. An advisory lock on the folder itself, which needs no file; the folder is made
/// if it is missing, and removed again, by the destructor, if nothing was put into it. Where there is no lock to be had (a
/// folder that cannot be made, a file system without locks) nobody waits. One process must not lock a folder twice at the
/// same time, nor a TemporaryFolder, which its owner has locked.
class FolderLock {
public:
    /// `onWait` is called once if another process holds the lock. Throws Inconclusive when the user interrupts the wait
    /// while a DeferredInterrupts is held.
    explicit FolderLock(const std::filesystem::path& folder, const std::function<void()>& onWait = {});
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    std::vector<std::filesystem::path> made_; // the deepest first
    Descriptor folder_{-1};
};

/// The lock of a verb's folder of results: says on standard error that it waits.
class OutputLock : public FolderLock {
public:
    explicit OutputLock(const std::filesystem::path& folder);
};

} // namespace shadowbench
