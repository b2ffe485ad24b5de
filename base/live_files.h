// Files that this process is writing and that must not be left behind where it ends without unwinding.
#pragma once

#include <cstddef>
#include <string>

namespace shadowbench {

/// One such file, from construction to destruction. Where too many are being written, or the path is too long, it is not
/// listed, and stays as a killed process' would (base/files.h).
class LiveFile {
public:
    explicit LiveFile(const std::string& path);
    ~LiveFile();
    LiveFile(const LiveFile&) = delete;
    LiveFile& operator=(const LiveFile&) = delete;

private:
    std::size_t place_;
};

/// Removes all of them. As a signal handler may: it takes no lock and allocates nothing.
void removeLiveFiles();

} // namespace shadowbench
