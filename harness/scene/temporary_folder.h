// A private folder that is gone when its owner is.
#pragma once

#include <filesystem>

namespace shadowbench {

/// A new folder under the system's temporary folder ($TMPDIR, else /tmp) that only this user can read. Removed, with all it
/// holds, by the destructor. Throws Inconclusive when it cannot be made.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace shadowbench
