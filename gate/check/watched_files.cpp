#include "gate/check/watched_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <sys/stat.h>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

/// Of a folder only that it is there: its files speak for themselves.
std::string stateOf(const fs::path& file) {
    struct stat found {};
    if (lstat(file.c_str(), &found) != 0) return "";
    if (S_ISDIR(found.st_mode)) return "folder";
    return fmt::format("{} {} {} {}", found.st_ino, found.st_size, found.st_ctim.tv_sec, found.st_ctim.tv_nsec);
}

} // namespace

WatchedFiles::WatchedFiles(fs::path folder) : folder_(std::move(folder)), before_(now()) {}

std::vector<fs::path> WatchedFiles::changed() const {
    const State after = now();
    std::vector<fs::path> paths;
    for (const auto& [path, state] : before_) {
        const auto found = after.find(path);
        if (found == after.end() || found->second != state) paths.push_back(path);
    }
    for (const auto& [path, state] : after)
        if (!before_.contains(path)) paths.push_back(path);
    std::ranges::sort(paths);
    return paths;
}

WatchedFiles::State WatchedFiles::now() const {
    State state;
    std::error_code gone;
    for (auto entry = fs::recursive_directory_iterator(folder_, fs::directory_options::skip_permission_denied, gone);
         entry != fs::recursive_directory_iterator(); entry.increment(gone)) {
        if (const fs::path name = entry->path().filename(); name == ".git" || name == "__pycache__")
            entry.disable_recursion_pending();
        else
            state.emplace(entry->path(), stateOf(entry->path()));
    }
    return state;
}

} // namespace shadowbench::gate
