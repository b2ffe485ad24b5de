// Files that a command must leave as they are: what it has written to is told by comparing before and after.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::gate {

class WatchedFiles {
public:
    /// All that lies under the folder now, but what git and Python keep for themselves (.git, __pycache__). Symbolic links
    /// are not followed; what cannot be read is not seen.
    explicit WatchedFiles(std::filesystem::path folder);

    /// Paths, as the folder's begins, of what was added, removed or written to since, in the order of their names. Two
    /// states are told apart by the time of the last change that the file system itself notes, which no program can set.
    [[nodiscard]] std::vector<std::filesystem::path> changed() const;

private:
    using State = std::map<std::filesystem::path, std::string>;
    [[nodiscard]] State now() const;

    std::filesystem::path folder_;
    State before_;
};

} // namespace shadowbench::gate
