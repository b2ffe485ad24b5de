#include "base/temporary_folder.h"

#include "base/descriptor.h"
#include "base/error.h"
#include "base/faults.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view prefix = "shadowbench-private-";
constexpr std::string_view unique = "XXXXXX"; // replaced by mkdtemp

int openFolder(const fs::path& folder) { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC); }

[[noreturn]] void failToMake(const fs::path& parent, int error) {
    throw Inconclusive(fmt::format("cannot make a temporary folder in {}: {}; free some space or set TMPDIR",
                                   parent.string(), std::generic_category().message(error)),
                       failureOf(error));
}

fs::path makeFolder(const fs::path& parent) {
    std::string name = (parent / prefix).string().append(unique);
    if (mkdtemp(name.data()) == nullptr) failToMake(parent, errno);
    return name;
}

/// As mkdtemp made it for this user.
bool isOurs(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && status.st_uid == geteuid() && (status.st_mode & 0777U) == 0700;
}

void removeIfAbandoned(const fs::path& folder) {
    const int descriptor = openFolder(folder);
    if (descriptor < 0) return;
    std::error_code ignored; // what cannot be removed now stays for the next
    if (isOurs(descriptor) && flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(folder, ignored);
    ::close(descriptor);
}

void removeAbandoned(const fs::path& parent) {
    std::error_code ignored;
    for (fs::directory_iterator i(parent, ignored), end; i != end; i.increment(ignored)) {
        const std::string name = i->path().filename().string();
        if (name.starts_with(prefix) && name.size() == prefix.size() + unique.size()) removeIfAbandoned(i->path());
    }
}

} // namespace

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    if (error) throw Inconclusive("cannot make a temporary folder: $TMPDIR is not a folder; set it to one that exists");
    removeAbandoned(parent);
    do {
        if (lock_ >= 0) ::close(lock_);
        path_ = makeFolder(parent);
        lock_ = faults::fails(faults::Point::Open, path_.c_str()) ? -1 : openFolder(path_);
        if (const int reason = errno; lock_ < 0 && reason != ENOENT) {
            ::rmdir(path_.c_str()); // the destructor is not called
            failToMake(parent, reason);
        }
        // Where the file system has no locks, nobody can take the folder for abandoned either.
        flock(lock_, LOCK_EX);
    } while (!isStillNamed(lock_, path_)); // another process may have taken it for a dead one's
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    ::close(lock_);
}

} // namespace shadowbench
