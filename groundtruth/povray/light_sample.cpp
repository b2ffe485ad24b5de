// The points at which POV-Ray samples an area light.
#include "groundtruth/povray/povray.h"

#include <bit>
#include <cstdint>

namespace shadowbench::groundtruth {
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

} // namespace

glm::dvec2 lightSample(int i, int n) {
    const double unit = 0x1p-32;
    const double halfCell = 0.5 / std::bit_ceil(static_cast<unsigned>(n));
    const auto index = static_cast<std::uint32_t>(i);
    return {unit * mirrored(index) + halfCell, unit * secondDimension(index) + halfCell};
}

SampleParts sampleParts(int samples) {
    const int firstHalf = (samples + 1) / 2;
    const int firstQuarter = (firstHalf + 1) / 2;
    return {firstQuarter, firstHalf - firstQuarter, samples - firstHalf};
}

} // namespace shadowbench::groundtruth
