#include "techniques/shared/sampling/light_points.h"

#include "techniques/shared/sampling/sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace shadowbench::techniques {
namespace {

glm::dvec2 onGrid(int i, int count) {
    const int side = std::max(1, static_cast<int>(std::sqrt(count)));
    return {(i % side + 0.5) / side, (i / side % side + 0.5) / side};
}

glm::dvec2 inUnitSquare(std::string_view pattern, int i, int count, std::uint32_t seed) {
    if (pattern == "grid") return onGrid(i, count);
    if (pattern == "halton") return {haltonOf(i, seed, 2), haltonOf(i, seed, 3)};
    return {(i + 0.5) / count, haltonOf(i, seed, 2)};
}

} // namespace

Parameter lightCountParameter(const std::string& meaning) {
    return {"n", "64", IntegerRange{1, 4096}, meaning, "Zápotocký 5.2 (64 and 100)"};
}

Parameter lightPatternParameter() {
    return {"pattern", "hammersley", OneOf{{"hammersley", "halton", "grid"}},
            "where the samples lie: Hammersley (its first coordinate is regular in n), Halton, or a grid of ⌊√n⌋ a side",
            "dissertation 4.2"};
}

std::vector<glm::dvec3> lightPoints(const Light& light, std::string_view pattern, int count, std::uint32_t seed) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) points.push_back(light.sample(inUnitSquare(pattern, i, count, seed)));
    return points;
}

} // namespace shadowbench::techniques
