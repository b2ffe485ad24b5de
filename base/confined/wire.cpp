#include "base/confined/wire.h"

#include "base/interrupts.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>

namespace shadowbench {
namespace {

constexpr std::size_t longestName = 4096;

/// Room for the control message that carries `files` descriptors, aligned as the kernel wants it.
struct ControlRoom {
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int) * kMostHandedFiles)> bytes{};
};

[[noreturn]] void ended() { throw WireError(WireError::Kind::Ended, "the other end has closed"); }

[[noreturn]] void malformed(const std::string& sentence) { throw WireError(WireError::Kind::Malformed, sentence); }

} // namespace

Wire::Wire(Descriptor socket, std::optional<Deadline> deadline) : socket_(std::move(socket)), deadline_(deadline) {}

void Wire::put(std::uint64_t number) { sendAll(&number, sizeof number); }

void Wire::put(std::string_view text) {
    put(std::uint64_t{text.size()});
    sendAll(text.data(), text.size());
}

void Wire::sendAll(const void* bytes, std::size_t count) const {
    const char* next = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t sent = ::send(socket_.get(), next, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return; // whoever receives notices
        next += sent;
        count -= static_cast<std::size_t>(sent);
    }
}

void Wire::waitForBytes() const {
    using std::chrono::milliseconds;
    if (!deadline_) return;
    for (;;) {
        const auto left = std::chrono::duration_cast<milliseconds>(*deadline_ - std::chrono::steady_clock::now());
        if (left <= milliseconds::zero()) throw WireError(WireError::Kind::Late, "nothing came in time");
        pollfd watched{socket_.get(), POLLIN, 0};
        constexpr milliseconds tick{100}; // between two looks for an interrupt
        if (::poll(&watched, 1, static_cast<int>(std::min(left, tick).count())) > 0) return;
        if (DeferredInterrupts::pending()) throw WireError(WireError::Kind::Interrupted, "interrupted");
    }
}

void Wire::receiveAll(void* bytes, std::size_t count) {
    char* next = static_cast<char*>(bytes);
    while (count > 0) {
        waitForBytes();
        const ssize_t received = ::recv(socket_.get(), next, count, 0);
        if (received < 0 && errno == EINTR) continue;
        if (received <= 0) ended();
        next += received;
        count -= static_cast<std::size_t>(received);
    }
}

std::uint64_t Wire::number(std::uint64_t most, const char* meaning) {
    std::uint64_t value = 0;
    receiveAll(&value, sizeof value);
    if (value > most) malformed(fmt::format("{} {}, at most {} can be", value, meaning, most));
    return value;
}

std::string Wire::text(std::size_t longest) {
    std::string text(number(longest, "bytes of a text"), '\0');
    receiveAll(text.data(), text.size());
    return text;
}

void Wire::hand(std::span<const OpenedFile> files) {
    std::array<int, kMostHandedFiles> numbers{};
    const std::size_t count = std::min(files.size(), kMostHandedFiles);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = files[i].descriptor.get();

    std::uint64_t announced = count;
    iovec data{&announced, sizeof announced};
    ControlRoom room;
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    if (count > 0) {
        message.msg_control = room.bytes.data();
        message.msg_controllen = CMSG_SPACE(sizeof(int) * count);
        cmsghdr* header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(sizeof(int) * count);
        std::memcpy(CMSG_DATA(header), numbers.data(), sizeof(int) * count);
    }
    while (::sendmsg(socket_.get(), &message, MSG_NOSIGNAL) < 0 && errno == EINTR) {
    }
    for (std::size_t i = 0; i < count; ++i) {
        put(files[i].name);
        put(files[i].size);
    }
}

std::vector<OpenedFile> Wire::takeHanded() {
    std::uint64_t announced = 0;
    iovec data{&announced, sizeof announced};
    ControlRoom room;
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    message.msg_control = room.bytes.data();
    message.msg_controllen = room.bytes.size();
    ssize_t received = 0;
    do {
        received = ::recvmsg(socket_.get(), &message, MSG_CMSG_CLOEXEC | MSG_WAITALL);
    } while (received < 0 && errno == EINTR);
    if (received != sizeof announced) ended();

    std::vector<OpenedFile> files;
    const cmsghdr* header = CMSG_FIRSTHDR(&message);
    const std::size_t come = header == nullptr ? 0 : (header->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < come; ++i) {
        int descriptor = -1;
        std::memcpy(&descriptor, CMSG_DATA(header) + i * sizeof(int), sizeof descriptor);
        files.push_back({"", 0, Descriptor(descriptor)});
    }
    if (files.size() != announced) malformed("other files were handed over than were announced");
    for (OpenedFile& file : files) {
        file.name = text(longestName);
        file.size = number(~std::uint64_t{0}, "bytes of a file");
    }
    return files;
}

} // namespace shadowbench
