#include "base/confined/passed_descriptors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <sys/socket.h>
#include <sys/uio.h>

namespace shadowbench {
namespace {

/// A message of one number, with room for descriptors beside it.
class Message {
public:
    Message() {
        data_ = {&number_, sizeof number_};
        header_.msg_iov = &data_;
        header_.msg_iovlen = 1;
        header_.msg_control = room_.data();
        header_.msg_controllen = room_.size();
    }
    Message(const Message&) = delete;
    Message& operator=(const Message&) = delete;

    void put(std::uint64_t number, std::span<const int> descriptors) {
        number_ = number;
        const std::size_t bytes = std::min(descriptors.size(), kMostPassed) * sizeof(int);
        if (bytes == 0) {
            header_.msg_control = nullptr;
            header_.msg_controllen = 0;
            return;
        }
        header_.msg_controllen = CMSG_SPACE(bytes);
        cmsghdr* control = CMSG_FIRSTHDR(&header_);
        control->cmsg_level = SOL_SOCKET;
        control->cmsg_type = SCM_RIGHTS;
        control->cmsg_len = CMSG_LEN(bytes);
        std::memcpy(CMSG_DATA(control), descriptors.data(), bytes);
    }

    [[nodiscard]] std::uint64_t number() const { return number_; }
    [[nodiscard]] std::vector<Descriptor> descriptors() const {
        std::vector<Descriptor> taken;
        const cmsghdr* control = CMSG_FIRSTHDR(&header_);
        if (control == nullptr || control->cmsg_type != SCM_RIGHTS) return taken;
        const std::size_t count = (control->cmsg_len - CMSG_LEN(0)) / sizeof(int);
        for (std::size_t i = 0; i < count; ++i) {
            int descriptor = -1;
            std::memcpy(&descriptor, CMSG_DATA(control) + i * sizeof(int), sizeof descriptor);
            taken.emplace_back(descriptor);
        }
        return taken;
    }
    [[nodiscard]] msghdr* header() { return &header_; }

private:
    std::uint64_t number_ = 0;
    iovec data_{};
    msghdr header_{};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int) * kMostPassed)> room_{};
};

} // namespace

bool passDescriptors(int socket, std::uint64_t number, std::span<const int> descriptors) {
    Message message;
    message.put(number, descriptors);
    ssize_t sent = 0;
    do {
        sent = ::sendmsg(socket, message.header(), MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent == sizeof number;
}

std::optional<std::pair<std::uint64_t, std::vector<Descriptor>>> takeDescriptors(int socket) {
    Message message;
    ssize_t received = 0;
    do {
        received = ::recvmsg(socket, message.header(), MSG_CMSG_CLOEXEC | MSG_WAITALL);
    } while (received < 0 && errno == EINTR);
    if (received != sizeof(std::uint64_t)) return std::nullopt;
    return std::pair(message.number(), message.descriptors());
}

} // namespace shadowbench
