// Whether the files that a technique folder draws with have changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace shadowbench::develop {

class FolderWatch {
public:
    /// The files as they are now count as changed: nobody has drawn them yet.
    explicit FolderWatch(std::filesystem::path folder) : folder_(std::move(folder)) {}

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
    std::optional<Files> seen_;
};

} // namespace shadowbench::develop
