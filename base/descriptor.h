// File descriptors that close themselves.
#pragma once

#include <filesystem>
#include <unistd.h>
#include <utility>

namespace shadowbench {

class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor& operator=(Descriptor&& other) noexcept {
        if (this != &other) {
            close();
            fd_ = std::exchange(other.fd_, -1);
        }
        return *this;
    }

    [[nodiscard]] int get() const { return fd_; }
    void close() {
        if (fd_ >= 0) ::close(std::exchange(fd_, -1));
    }

private:
    int fd_;
};

/// Whether `path` still names the file or folder that is open: another process may have removed or replaced it.
bool isStillNamed(int descriptor, const std::filesystem::path& path);

/// Two ends, joined both ways, that no program started later inherits. Throws Inconclusive when the system has no more.
std::pair<Descriptor, Descriptor> makeSockets();

} // namespace shadowbench
