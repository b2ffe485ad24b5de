#include "studies/develop/folder_watch.h"

#include <chrono>
#include <sys/stat.h>
#include <system_error>
#include <thread>

namespace shadowbench::develop {
namespace {

namespace fs = std::filesystem;

std::int64_t nanoseconds(const timespec& time) { return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec; }

/// Editors leave files of their own beside those that they edit.
bool isDrawnWith(const fs::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".glsl" || ending == ".frag" || ending == ".comp" || file.filename() == "technique.toml";
}

} // namespace

FolderWatch::Files FolderWatch::filesNow() const {
    Files files;
    const auto add = [&](const fs::path& file) { // one that is being replaced is not there for a moment
        struct stat status {};
        if (::stat(file.c_str(), &status) != 0) return;
        files[file.string()] = {status.st_ino, static_cast<std::uint64_t>(status.st_size), nanoseconds(status.st_mtim),
                                nanoseconds(status.st_ctim)};
    };
    std::error_code ignored; // nor is the folder
    for (fs::directory_iterator i(folder_, ignored), end; i != end; i.increment(ignored))
        if (isDrawnWith(i->path())) add(i->path());
    for (const fs::path& file : others_) add(file);
    return files;
}

void FolderWatch::settle(const std::function<bool()>& givesUp) {
    constexpr std::chrono::milliseconds quiet{50};
    Files before = filesNow();
    for (;;) {
        std::this_thread::sleep_for(quiet);
        Files now = filesNow();
        if (now == before || givesUp()) {
            seen_ = std::move(now);
            return;
        }
        before = std::move(now);
    }
}

} // namespace shadowbench::develop
