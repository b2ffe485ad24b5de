#include "base/confined/wire.h"

#include "base/confined/passed_descriptors.h"
#include "base/interrupts.h"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

namespace shadowbench {
namespace {

constexpr std::size_t longestName = 4096;

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
    std::vector<int> descriptors;
    for (const OpenedFile& file : files) descriptors.push_back(file.descriptor.get());
    passDescriptors(socket_.get(), files.size(), descriptors);
    for (const OpenedFile& file : files) {
        put(file.name);
        put(file.size);
    }
}

std::vector<OpenedFile> Wire::takeHanded() {
    auto handed = takeDescriptors(socket_.get());
    if (!handed) ended();
    auto& [announced, descriptors] = *handed;
    if (descriptors.size() != announced) malformed("other files were handed over than were announced");
    std::vector<OpenedFile> files;
    for (Descriptor& descriptor : descriptors) {
        std::string name = text(longestName);
        files.push_back({std::move(name), number(~std::uint64_t{0}, "bytes of a file"), std::move(descriptor)});
    }
    return files;
}

} // namespace shadowbench
