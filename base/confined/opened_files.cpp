#include "base/confined/opened_files.h"

#include "base/error.h"
#include "base/faults.h"
#include "base/limits.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& why, const std::string& doing = "cannot read") {
    throw BadInput(fmt::format("{} {}: {}", doing, file.string(), why));
}

/// `shown`: the path for messages.
OpenedFile checked(Descriptor descriptor, const fs::path& shown, std::string name) {
    struct stat status {};
    if (::fstat(descriptor.get(), &status) != 0) fail(shown, std::strerror(errno));
    if (S_ISDIR(status.st_mode)) fail(shown, "it is a folder; name a file");
    if (!S_ISREG(status.st_mode)) fail(shown, "it is a pipe or a device; name a regular file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    constexpr std::uint64_t mib = 1 << 20;
    if (size > limitOf(Limit::FileMib) * mib)
        fail(shown, fmt::format("it has {} MiB, {}", (size + mib - 1) / mib, beyond(Limit::FileMib)));
    return {std::move(name), size, std::move(descriptor)};
}

/// The names between the slashes, without "."; throws where one leads out.
std::vector<std::string> stepsOf(const fs::path& folder, const std::string& name) {
    const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    if (std::ranges::any_of(name, isControl)) fail(folder / "", "a file in it is named with control characters");
    if (name.empty() || name.front() == '/')
        fail(folder / "", fmt::format("\"{}\" is no relative path of a file below it", name));
    std::vector<std::string> steps;
    for (const fs::path& step : fs::path(name)) {
        if (step == "..") fail(folder / name, "a file may name only files below its own folder, so without \"..\"");
        if (step != ".") steps.push_back(step.string());
    }
    return steps;
}

} // namespace

OpenedFile openRegular(const fs::path& file, const std::string& doing) {
    // Without waiting for whoever would write into a pipe of that name.
    const bool fails = faults::fails(faults::Point::Open, file.c_str());
    Descriptor descriptor(fails ? -1 : ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (descriptor.get() < 0) fail(file, std::strerror(errno), doing);
    return checked(std::move(descriptor), file, file.filename().string());
}

OpenedFile openBelow(const fs::path& folder, const std::string& name) {
    std::vector<std::string> steps = stepsOf(folder, name);
    const fs::path shown = folder / name;
    Descriptor at(::open(folder.empty() ? "." : folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (at.get() < 0) fail(folder, std::strerror(errno));
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const int kind = i + 1 < steps.size() ? O_PATH | O_DIRECTORY : O_RDONLY | O_NONBLOCK | O_NOCTTY;
        Descriptor next(::openat(at.get(), steps[i].c_str(), kind | O_NOFOLLOW | O_CLOEXEC));
        const int why = errno;
        struct stat status {};
        const bool isLink = next.get() < 0 && ::fstatat(at.get(), steps[i].c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                            S_ISLNK(status.st_mode);
        if (isLink) fail(shown, "it is reached through a symbolic link, which a foreign file may not name");
        if (next.get() < 0) fail(shown, std::strerror(why));
        std::swap(at, next);
    }
    return checked(std::move(at), shown, name);
}

std::string contentOf(const OpenedFile& file) {
    std::string bytes(file.size, '\0');
    std::uint64_t done = 0;
    while (done < file.size) {
        const ssize_t count =
            ::pread(file.descriptor.get(), bytes.data() + done, file.size - done, static_cast<off_t>(done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(file.name, std::strerror(errno));
        if (count == 0) fail(file.name, "it became shorter while it was read");
        done += static_cast<std::uint64_t>(count);
    }
    return bytes;
}

} // namespace shadowbench
