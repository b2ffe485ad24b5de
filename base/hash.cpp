#include "base/hash.h"

#include <fmt/format.h>
#include <new>
#include <xxhash.h>

namespace shadowbench {

std::string Hash128::text() const { return fmt::format("{:016x}{:016x}", high, low); }

Hash128 hash128(std::string_view bytes, std::uint64_t seed) {
    const XXH128_hash_t hash = XXH3_128bits_withSeed(bytes.data(), bytes.size(), seed);
    return {hash.high64, hash.low64};
}

struct Hasher128::State {
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> xxh{XXH3_createState(), &XXH3_freeState};
};

Hasher128::Hasher128() : state_(std::make_unique<State>()) {
    if (!state_->xxh) throw std::bad_alloc();
    XXH3_128bits_reset(state_->xxh.get());
}

Hasher128::~Hasher128() = default;

void Hasher128::add(const void* data, std::size_t bytes) { XXH3_128bits_update(state_->xxh.get(), data, bytes); }

Hash128 Hasher128::digest() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh.get());
    return {hash.high64, hash.low64};
}

std::uint64_t hash64(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

} // namespace shadowbench
