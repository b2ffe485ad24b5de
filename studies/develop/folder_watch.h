// Whether the files that a technique folder is drawn with have changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench::develop {

class FolderWatch {
public:
    /// Of a folder, which may be none (""), and of other `files`. As they are now they count as changed: nobody has drawn
    /// them yet.
    FolderWatch(std::filesystem::path folder, std::vector<std::filesystem::path> files)
        : folder_(std::move(folder)), others_(std::move(files)) {}

    /// Whether they are others than when they last settled.
    [[nodiscard]] bool changed() const { return !seen_ || filesNow() != *seen_; }

    /// Returns once they have been the same for a while, as an editor may write a file in two steps, or `givesUp` says so.
    void settle(const std::function<bool()>& givesUp);

private:
    /// What tells one state of a file from another: inode, size, and when contents and place were last changed, in ns.
    using FileState = std::tuple<std::uint64_t, std::uint64_t, std::int64_t, std::int64_t>;
    using Files = std::map<std::string, FileState>;
    [[nodiscard]] Files filesNow() const;

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> others_;
    std::optional<Files> seen_;
};

} // namespace shadowbench::develop
