// What a process and the child that reads a file for it say to each other: whole numbers, texts and arrays over a socket,
// each checked against a bound before anything is allocated for it. Both are the same program on one machine, so numbers lie
// as they lie in memory.
#pragma once

#include "base/confined/opened_files.h"
#include "base/descriptor.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace shadowbench {

/// Why nothing more can be received.
class WireError : public std::runtime_error {
public:
    enum class Kind { Ended, Late, Interrupted, Malformed };
    WireError(Kind kind, const std::string& sentence) : std::runtime_error(sentence), kind_(kind) {}
    [[nodiscard]] Kind kind() const { return kind_; }

private:
    Kind kind_;
};

class Wire {
public:
    using Deadline = std::chrono::steady_clock::time_point;

    /// `deadline`: until when all that is received must have come; none: it is waited for as long as the other end lives.
    explicit Wire(Descriptor socket, std::optional<Deadline> deadline = {});

    void setDeadline(Deadline deadline) { deadline_ = deadline; }

    // Sending never waits for an answer; what the other end does not take is dropped, once it has ended.
    void put(std::uint64_t number);
    void put(std::string_view text);
    template <typename T>
    void put(std::span<const T> array) {
        static_assert(std::is_trivially_copyable_v<T>);
        sendAll(array.data(), array.size_bytes());
    }

    /// Gives the other end copies of at most kMostPassed descriptors, with their names and sizes.
    void hand(std::span<const OpenedFile> files);

    // All throw WireError.
    /// A number of at most `most`, of what `meaning` says.
    std::uint64_t number(std::uint64_t most, const char* meaning);
    std::string text(std::size_t longest);
    template <typename T>
    void fill(std::span<T> array) {
        static_assert(std::is_trivially_copyable_v<T>);
        receiveAll(array.data(), array.size_bytes());
    }
    std::vector<OpenedFile> takeHanded();

private:
    void sendAll(const void* bytes, std::size_t count) const;
    void receiveAll(void* bytes, std::size_t count);
    void waitForBytes() const;

    Descriptor socket_;
    std::optional<Deadline> deadline_;
};

} // namespace shadowbench
