#include "techniques/shared/sampling/jitter.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace shadowbench::techniques {
namespace {

/// PCG hash (Jarzynski and Olano 2020).
std::uint32_t hash(std::uint32_t value) {
    const std::uint32_t state = value * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

constexpr std::uint32_t mostDrawn = 4096; // numbers that one set draws

/// In [0, 1).
double chance(std::uint32_t value) { return hash(value) / 4294967296.0; }

} // namespace

glm::dvec2 warpedToDisk(double u, double v) {
    const double angle = glm::two_pi<double>() * u;
    return {std::sqrt(v) * std::cos(angle), std::sqrt(v) * std::sin(angle)};
}

std::vector<glm::vec2> jitteredTaps(const JitterGrid& grid, std::uint32_t set) {
    std::vector<glm::vec2> taps;
    std::uint32_t drawn = mostDrawn * set;
    for (int ring = grid.rings - 1; ring >= 0; --ring)
        for (int sector = 0; sector < grid.sectors; ++sector) {
            const double u = (sector + chance(drawn++)) / grid.sectors;
            const double v = (ring + chance(drawn++)) / grid.rings;
            taps.emplace_back(warpedToDisk(u, v));
        }
    return taps;
}

} // namespace shadowbench::techniques
