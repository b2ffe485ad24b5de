#include "techniques/shared/sampling/light_samples.h"

#include "techniques/shared/sampling/sampling.h"

#include <cstddef>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {

std::vector<glm::vec2> lightSamples(int side) {
    std::vector<glm::vec2> points;
    for (int row = 0; row < side; ++row)
        for (int i = 0; i < side; ++i) {
            // Van der Corput's number k / side, so that the middle of a stratum of side² is half a stratum on.
            const double shift = halton(static_cast<std::uint32_t>(row), 2) + 0.5 / side;
            const glm::dvec2 cell(i + shift, row + (i + 0.5) / side);
            points.emplace_back(2.0 * cell / static_cast<double>(side) - 1.0);
        }
    return points;
}

std::vector<std::uint32_t> samplesOutsideDisk(int side) {
    const std::vector<glm::vec2> points = lightSamples(side);
    std::vector<std::uint32_t> words((points.size() + 31) / 32, 0);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (glm::length(points[i]) > 1) words[i / 32] |= 1U << (i % 32);
    return words;
}

} // namespace shadowbench::techniques
