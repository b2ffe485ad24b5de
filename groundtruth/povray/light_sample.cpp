// The points at which POV-Ray samples an area light.
#include "groundtruth/povray/povray.h"

#include "base/random.h"

#include <bit>
#include <cstdint>

namespace shadowbench::groundtruth::povray {
namespace {

/// First Sobol dimension (van der Corput): the bits of `i` mirrored.
std::uint32_t mirrored(std::uint32_t i) {
    std::uint32_t result = 0;
    for (std::uint32_t bit = 1U << 31; i != 0; i >>= 1, bit >>= 1)
        if ((i & 1U) != 0) result ^= bit;
    return result;
}

/// Second Sobol dimension (primitive polynomial x + 1): direction numbers v ← v ⊕ v/2.
std::uint32_t secondDimension(std::uint32_t i) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 1U << 31; i != 0; i >>= 1, direction ^= direction >> 1)
        if ((i & 1U) != 0) result ^= direction;
    return result;
}

/// Owen's nested scrambling (1995) of the leading `bits`: each is flipped or not by a hash of those above it. That permutes
/// the halves of every elementary interval, so nets stay nets.
std::uint32_t scrambled(std::uint32_t x, int bits, std::uint64_t dimension) {
    std::uint64_t above = 1; // the bits so far after a leading one, which tells 0 from 00
    std::uint32_t result = 0;
    for (int bit = 0; bit < bits; ++bit) {
        const std::uint32_t mine = (x >> (31 - bit)) & 1U;
        result |= (mine ^ static_cast<std::uint32_t>(mixBits((dimension << 32) | above) & 1U)) << (31 - bit);
        above = (above << 1) | mine;
    }
    return result;
}

} // namespace

glm::dvec2 lightSample(int i, int n, std::uint32_t set) {
    const double unit = 0x1p-32;
    const unsigned cells = std::bit_ceil(static_cast<unsigned>(n));
    const int bits = std::countr_zero(cells);
    const double halfCell = 0.5 / cells;
    const auto index = static_cast<std::uint32_t>(i);
    const std::uint64_t dimension = 2 * std::uint64_t{set};
    return {unit * scrambled(mirrored(index), bits, dimension) + halfCell,
            unit * scrambled(secondDimension(index), bits, dimension + 1) + halfCell};
}

SampleParts sampleParts(int samples) {
    const int firstHalf = (samples + 1) / 2;
    const int firstQuarter = (firstHalf + 1) / 2;
    return {firstQuarter, firstHalf - firstQuarter, samples - firstHalf};
}

} // namespace shadowbench::groundtruth::povray
