#include "techniques/environment/cube_map.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace shadowbench::techniques {
namespace {

/// The solid angle between a face's middle and (x, y), with their signs.
double quadrant(double x, double y) { return std::atan(x * y / std::sqrt(x * x + y * y + 1)); }

/// Interleaves the bits of a point's coordinates, so that neighbours on the curve are neighbours on the face.
std::uint32_t alongCurve(const CubePoint& point) {
    constexpr unsigned bits = 8;
    const auto cell = [](double x) {
        return static_cast<std::uint32_t>(std::clamp(0.5 * (x + 1) * (1U << bits), 0.0, (1U << bits) - 1.0));
    };
    const std::uint32_t x = cell(point.at.x), y = cell(point.at.y);
    auto code = static_cast<std::uint32_t>(point.face);
    for (unsigned bit = bits; bit-- > 0;) code = code << 2U | (x >> bit & 1U) << 1U | (y >> bit & 1U);
    return code;
}

} // namespace

glm::dvec3 directionOf(const CubePoint& point) {
    const int axis = point.face / 2;
    glm::dvec3 direction;
    direction[axis] = point.face % 2 == 0 ? 1 : -1;
    direction[(axis + 1) % 3] = point.at.x;
    direction[(axis + 2) % 3] = point.at.y;
    return glm::normalize(direction);
}

CubePoint cubePointOf(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return {2 * axis + (direction[axis] < 0 ? 1 : 0),
            glm::dvec2(direction[(axis + 1) % 3], direction[(axis + 2) % 3]) / size[axis]};
}

double solidAngle(const glm::dvec2& low, const glm::dvec2& high) {
    return quadrant(high.x, high.y) - quadrant(low.x, high.y) - quadrant(high.x, low.y) + quadrant(low.x, low.y);
}

std::vector<DirectionSample> cubeSamples(int side, int across) {
    std::vector<DirectionSample> samples;
    samples.reserve(cubeTexels(side) * static_cast<std::size_t>(across * across));
    Random random(1);
    const double cell = 2.0 / (side * across);
    for (std::size_t texel = 0; texel < cubeTexels(side); ++texel) {
        const auto inFace = static_cast<int>(texel % static_cast<std::size_t>(side * side));
        const glm::dvec2 corner = glm::dvec2(inFace % side, inFace / side) * (cell * across) - 1.0;
        for (int i = 0; i < across * across; ++i) {
            const glm::dvec2 low = corner + glm::dvec2(i % across, i / across) * cell;
            const glm::dvec2 within(random.uniform(), random.uniform());
            const int face = static_cast<int>(texel / static_cast<std::size_t>(side * side));
            samples.push_back({glm::vec3(directionOf({face, low + within * cell})), solidAngle(low, low + cell), texel});
        }
    }
    return samples;
}

std::vector<DirectionSample> evenSamples(int count) {
    std::vector<DirectionSample> samples;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count;
        const double azimuth = glm::two_pi<double>() * glm::fract(i / glm::golden_ratio<double>());
        const double radius = std::sqrt(1 - z * z);
        samples.push_back(
            {glm::vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), z), 4 * glm::pi<double>() / count, 0});
    }
    std::ranges::stable_sort(
        samples, {}, [](const DirectionSample& sample) { return alongCurve(cubePointOf(glm::dvec3(sample.direction))); });
    return samples;
}

} // namespace shadowbench::techniques
