// Random numbers that are the same on every machine and compiler (the standard library's distributions are not).
#pragma once

#include <cstdint>

namespace shadowbench {

/// SplitMix64's finaliser (Steele, Lea and Flood 2014): every input bit changes about half of the output bits.
constexpr std::uint64_t mixBits(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15U;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31U);
}

/// The hash of a word as a number in [0, 1).
constexpr double hashed(std::uint64_t x) { return static_cast<double>(mixBits(x) >> 11U) * 0x1p-53; }

/// A stream of numbers from a seed.
class Random {
public:
    explicit constexpr Random(std::uint64_t seed) : state_(mixBits(seed)) {}

    /// Uniform in [0, 1).
    constexpr double uniform() { return hashed(state_++); }
    constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }

private:
    std::uint64_t state_;
};

} // namespace shadowbench
