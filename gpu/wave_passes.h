// What waves pass, from what each of their lanes passes: the lane that passes a mark most often decides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace shadowbench::gpu {

/// For each mark, the sum over waves of what their longest lane passes it. A wave takes both sides of a condition that its
/// lanes part at; of one within a loop, whose sides different lanes may take in different rounds, this is the least that it
/// takes. Mark 0 is main's: how many waves ran.
struct WavePasses {
    std::vector<std::uint64_t> quads, waves32, waves64; // of 4, 32 and 64 lanes
    std::vector<std::uint64_t> longest32, longest64; // of the wave alone that passes most marks; then of the next target's

    void add(const WavePasses& other);
    [[nodiscard]] bool empty() const { return waves64.empty() || waves64.front() == 0; }
};

/// `counts` holds for each lane, row by row of an image of `width` × `height` pixels, its passes of each of `marks` marks.
/// Waves are squares of 2 × 2, 8 × 4 and 8 × 8 pixels.
WavePasses passesOfPixels(std::span<const std::uint32_t> counts, std::size_t marks, std::size_t width, std::size_t height);

/// Of groups of `group` lanes each. Waves are lanes that follow each other in one group.
WavePasses passesOfGroups(std::span<const std::uint32_t> counts, std::size_t marks, std::size_t group);

} // namespace shadowbench::gpu
