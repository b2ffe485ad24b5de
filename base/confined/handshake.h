// How the conversation between a process and the child that reads for it begins; both halves of base/confined/reader.h.
#pragma once

#include "base/confined/confinement.h"
#include "base/confined/wire.h"

#include <cstdint>

namespace shadowbench::handshake {

constexpr const char* variable = "SHADOWBENCH_READER"; // of the child's environment: which reader it is
constexpr std::uint64_t magic = 0x3152524652424853;    // "SHBRFRR1"; its last digit is the version
constexpr std::size_t longestRefusal = 1000;           // bytes
constexpr std::uint64_t mostSeconds = 1'000'000;

enum class Status : std::uint64_t { Refused, Answers };
constexpr std::uint64_t lastStatus = 1;

/// The child's first word, once it is confined.
inline void announce(Wire& wire, const Protections& protections) {
    wire.put(magic);
    wire.put(protections.packed());
}

inline void begin(Wire& wire, Status status) { wire.put(static_cast<std::uint64_t>(status)); }

} // namespace shadowbench::handshake
