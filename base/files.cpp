#include "base/files.h"

#include "base/descriptor.h"
#include "base/error.h"
#include "base/faults.h"
#include "base/interrupts.h"
#include "base/limits.h"
#include "base/live_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace shadowbench {
namespace fs = std::filesystem;
using faults::fails;
using faults::Point;
namespace {

[[noreturn]] void failToWrite(const fs::path& file, std::string_view reason, Failure failure) {
    throw InternalError(fmt::format("cannot write {}: {}; free some space or choose another place", file.string(), reason),
                        failure);
}

[[noreturn]] void failToWrite(const fs::path& file, int errorNumber) {
    failToWrite(file, std::strerror(errorNumber), failureOf(errorNumber));
}

constexpr std::string_view mark = ".shadowbench-"; // in the name of every temporary file
constexpr std::string_view unique = "XXXXXX";      // replaced by mkostemps
constexpr std::size_t longestStem = 180;           // bytes of the target's: a name has at most 255

/// A writer that lives holds a lock on its file. What cannot be removed now stays for the next.
void removeIfAbandoned(const fs::path& file) {
    const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (descriptor.get() >= 0 && ::flock(descriptor.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(file.c_str());
}

/// Removes what killed writers have left in the folder; looks once in each process, since folders can hold many files.
void removeLeftovers(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> seen;
    {
        const std::scoped_lock lock(mutex);
        if (!seen.insert(folder).second) return;
    }
    std::error_code ignored;
    for (fs::directory_iterator i(folder, ignored), end; i != end; i.increment(ignored))
        if (isTemporary(i->path())) removeIfAbandoned(i->path());
}

/// Waits until what is in the file or folder is on the disk; 0, or why that failed.
int flush(const fs::path& path, int flags) {
    const Descriptor descriptor(fails(Point::Open, path.c_str()) ? -1 : ::open(path.c_str(), flags | O_RDONLY | O_CLOEXEC));
    if (descriptor.get() < 0) return errno;
    return !fails(Point::Fsync, path.c_str()) && ::fsync(descriptor.get()) == 0 ? 0 : errno;
}

/// So that the names in `folder` outlive a power cut, too; 0, or why they may not. Some file systems cannot flush a folder,
/// and a folder that may be written but not read cannot be opened: neither is a failure to write.
int flushFolder(const fs::path& folder) {
    const int failed = flush(folder.empty() ? "." : folder, O_DIRECTORY);
    const bool cannot = failed == EINVAL || failed == ENOTSUP || failed == EACCES || failed == EPERM;
    return cannot ? 0 : failed;
}

/// The path of a file that is removed in the end; empty: of none.
struct RemovedPath {
    std::string text;

    RemovedPath() = default;
    RemovedPath(const RemovedPath&) = delete;
    RemovedPath& operator=(const RemovedPath&) = delete;
    ~RemovedPath() {
        if (!text.empty()) ::unlink(text.c_str());
    }
};

/// A file of its own name beside `target`, removed again unless it was renamed to its target.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        const std::string extension = target.extension().string();
        const std::string stem = target.stem().string().substr(0, longestStem);
        const std::string name = (target.parent_path() / fmt::format(".{}{}{}{}", stem, mark, unique, extension)).string();
        do {
            if (fails(Point::Open, name.c_str())) failToWrite(target, errno);
            std::string made = name;
            descriptor_ = Descriptor(::mkostemps(made.data(), static_cast<int>(extension.size()), O_CLOEXEC));
            if (descriptor_.get() < 0) failToWrite(target, errno);
            path_.text = std::move(made);
            // Where the file system has no locks, nobody can take the file for abandoned either.
            ::flock(descriptor_.get(), LOCK_EX);
        } while (!isStillNamed(descriptor_.get(), path_.text)); // another process may have taken it for a dead one's
        ::fchmod(descriptor_.get(), 0644);                      // it was made private to its owner
        live_.emplace(path_.text);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    [[nodiscard]] fs::path path() const { return path_.text; }

    /// `lasting`: it outlives a power cut, in which a file that was renamed before it was on the disk can be left empty.
    void moveToTarget(bool lasting) {
        if (const int failed = lasting ? flush(path_.text, 0) : 0; failed != 0) failToWrite(target_, failed);
        if (fails(Point::Rename, target_.c_str(), path_.text.c_str()) || ::rename(path_.text.c_str(), target_.c_str()) != 0)
            failToWrite(target_, errno);
        path_.text.clear();
        live_.reset();
        if (const int failed = lasting ? flushFolder(target_.parent_path()) : 0; failed != 0) failToWrite(target_, failed);
    }

private:
    DeferredInterrupts deferred_; // destroyed last
    fs::path target_;
    RemovedPath path_;
    std::optional<LiveFile> live_;
    Descriptor descriptor_{-1}; // holds the lock
};

void writeWhole(const fs::path& path, const fs::path& target, std::string_view content) {
    std::FILE* stream = fails(Point::Open, path.c_str()) ? nullptr : std::fopen(path.c_str(), "wb");
    if (stream == nullptr) failToWrite(target, errno);
    const bool written =
        !fails(Point::Write, path.c_str()) && std::fwrite(content.data(), 1, content.size(), stream) == content.size();
    int failed = written ? 0 : errno;
    if (std::fclose(stream) != 0 && failed == 0) failed = errno;
    if (failed != 0) failToWrite(target, failed);
}

void replace(const fs::path& file, const std::function<void(const fs::path&)>& write, bool lasting) {
    std::error_code ignored;
    // Renaming would replace a device or a pipe by a file of the same name. Asked once: another process may remove it.
    const fs::file_status there = fs::status(file, ignored);
    if (fs::exists(there) && !fs::is_regular_file(there))
        failToWrite(file, "it exists and is not a regular file", Failure::Lasting);
    std::error_code failed;
    if (lasting)
        (void)makeFolders(file.parent_path(), failed);
    else if (file.has_parent_path())
        fs::create_directories(file.parent_path(), failed);
    if (failed) failToWrite(file, failed.value());
    removeLeftovers(file.has_parent_path() ? file.parent_path() : ".");
    TemporaryFile temporary(file);
    write(temporary.path());
    temporary.moveToTarget(lasting);
}

} // namespace

void writeFile(const fs::path& file, std::string_view content) {
    writeFileWith(file, [&](const fs::path& path) { writeWhole(path, file, content); });
}

void writeFileWith(const fs::path& file, const std::function<void(const fs::path&)>& write) { replace(file, write, true); }

void writeFileUnflushed(const fs::path& file, std::string_view content) {
    replace(
        file, [&](const fs::path& path) { writeWhole(path, file, content); }, false);
}

std::vector<fs::path> makeFolders(const fs::path& folder, std::error_code& failed) {
    std::vector<fs::path> missing;
    for (fs::path p = folder; !p.empty() && !fs::exists(p, failed) && p != p.parent_path(); p = p.parent_path())
        missing.push_back(p);
    failed.clear();
    if (missing.empty()) return missing;
    fs::create_directories(folder, failed);
    for (const fs::path& made : missing)
        if (!failed) failed = std::error_code(flushFolder(made.parent_path()), std::generic_category());
    return missing;
}

bool isTemporary(const fs::path& file) {
    const std::string name = file.filename().string();
    const std::size_t at = name.rfind(mark);
    if (!name.starts_with('.') || at == name.npos || at == 0) return false;
    const std::size_t end = at + mark.size() + unique.size();
    return name.size() == end || (name.size() > end && name[end] == '.');
}

std::string readFile(const fs::path& file) {
    std::error_code failure;
    if (fs::is_directory(file, failure))
        throw BadInput(fmt::format("cannot read {}: it is a folder; name a file", file.string()));
    std::ifstream stream;
    if (!fails(Point::Open, file.c_str())) {
        errno = 0;
        stream.open(file, std::ios::binary);
    }
    const std::uint64_t most = limitOf(Limit::TextMib) << 20U; // of a device there is no end
    std::string text;
    for (std::array<char, 1 << 16> block{}; stream.good();) {
        stream.read(block.data(), block.size());
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        if (text.size() > most)
            throw BadInput(fmt::format("cannot read {}: it has {} bytes and more, {}", file.string(), text.size(),
                                       beyond(Limit::TextMib)));
    }
    if (!stream.is_open() || stream.bad())
        throw BadInput(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno != 0 ? errno : EIO)));
    return text;
}

} // namespace shadowbench
