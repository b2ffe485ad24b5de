// The table that pixels take their jittered taps from (Zápotocký 3.4): a block of pixels has as many sets of taps, and
// blocks repeat over the image, so that no pixel has a neighbour's taps.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/sampling/jitter.h"

#include <cstdint>

namespace shadowbench::techniques {

/// Pixels per side of a block.
inline constexpr int jitterBlock = 32;

/// Of an even number of taps. Read by shared/filters/jitter_table.glsl. Departure from the source's 3-D texture: its layers
/// are the rows of a 2-D one.
class JitterTable {
public:
    /// Of the jitterBlock² sets of taps from number `first` on.
    explicit JitterTable(const JitterGrid& grid, std::uint32_t first = 0);

    /// RGBA32F, two taps of the unit disk a texel: of the pixel (x, y) of the block and taps 2i and 2i + 1 in column x +
    /// jitterBlock · y of row i.
    [[nodiscard]] const gl::Texture& texture() const { return table_; }

    static gl::Defines defines();

    /// By how many pixels the blocks are shifted: each seed has a noise of its own.
    static glm::vec2 origin(std::uint32_t seed);

private:
    gl::Texture table_;
};

} // namespace shadowbench::techniques
