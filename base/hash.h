// Content hashes: XXH3 (xxhash.com). They tell contents apart; they do not protect against an attacker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace shadowbench {

/// XXH3-128.
struct Hash128 {
    std::uint64_t high = 0, low = 0;

    [[nodiscard]] std::string text() const; // 32 lower-case hex digits, `high` first

    friend bool operator==(const Hash128&, const Hash128&) = default;
};

Hash128 hash128(std::string_view bytes, std::uint64_t seed = 0);

/// The hash of bytes that are given piece by piece: the same as of all of them at once.
class Hasher128 {
public:
    Hasher128();
    ~Hasher128();
    Hasher128(const Hasher128&) = delete;
    Hasher128& operator=(const Hasher128&) = delete;

    void add(const void* data, std::size_t bytes);
    [[nodiscard]] Hash128 digest() const; // of what was added so far

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// XXH3-64.
std::uint64_t hash64(std::string_view bytes);

} // namespace shadowbench
