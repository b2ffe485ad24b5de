// Graphics cards that the model of costs knows by name: what each can do in a second, with where that is stated.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::gpu {

/// What is counted, all in a second.
enum class Rate {
    Arithmetic,   // cycles of all SIMDs together, each of 32 lanes
    Clock,        // cycles of one SIMD
    Texture,      // reads of a texture, and of buffers at places that lanes do not share
    Output,       // pixels of a colour target, however few bytes they have
    OutputBytes,  // bytes of colour targets that are written or cleared
    BlendedBytes, // bytes of targets of 32-bit floats that are blended
    Depth,        // pixels of a depth buffer that are written or cleared
    Tested,       // pixels of which neither colour nor depth is written
    Geometry,     // triangles that share no vertex
    Memory,       // bytes
    Draws,
    Passes,     // targets that are changed; what draws into the next one waits for nothing
    Dependents, // targets, dispatches and copies that read what the one before wrote
    ReadBacks
};
inline constexpr std::size_t rateCount = 14;

struct Card {
    std::string id, name;
    int lanes = 32; // of a wave: 32 or 64
    std::array<double, rateCount> rates{};

    [[nodiscard]] double operator[](Rate rate) const { return rates.at(static_cast<std::size_t>(rate)); }
};

/// As in a card's file: "output_bytes".
std::string_view name(Rate rate);

/// A card from the text of its file, which `file` names in errors. Throws BadInput, `file:line: key: what is wrong`: also
/// where a rate has no source.
Card parseCard(const std::string& text, const std::string& file);

/// The built-in ones (gpu/cards), sorted by id.
const std::vector<Card>& cards();

/// Throws BadInput with near matches.
const Card& cardNamed(const std::string& id);

} // namespace shadowbench::gpu
