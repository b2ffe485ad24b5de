#include "techniques/environment/cube_light.h"

#include "techniques/environment/cube_map.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <variant>

namespace shadowbench::techniques {
namespace {

/// A texel of a face.
struct Texel {
    int face;
    glm::dvec2 low, high;

    Texel(std::size_t number, int side) {
        const auto across = static_cast<std::size_t>(side), inFace = number % (across * across);
        face = static_cast<int>(number / (across * across));
        low = 2.0 / side * glm::dvec2(inFace % across, inFace / across) - 1.0;
        high = low + 2.0 / side;
    }

    /// Mean of `value` over a grid of across × across directions, weighted by solid angle.
    template <typename Value>
    [[nodiscard]] double mean(int across, const Value& value) const {
        const glm::dvec2 cell = (high - low) / static_cast<double>(across);
        double sum = 0, whole = 0;
        for (int i = 0; i < across * across; ++i) {
            const glm::dvec2 corner = low + glm::dvec2(i % across, i / across) * cell;
            const double weight = solidAngle(corner, corner + cell);
            sum += weight * value(directionOf({face, corner + 0.5 * cell}));
            whole += weight;
        }
        return sum / whole;
    }

    [[nodiscard]] glm::dvec3 middle() const { return directionOf({face, 0.5 * (low + high)}); }
    [[nodiscard]] double angle() const { return solidAngle(low, high); }
};

std::vector<double> skyTexels(const Sky& sky, int side) {
    if (const auto* constant = std::get_if<ConstantSky>(&sky))
        return std::vector<double>(cubeTexels(side), constant->radiance);
    constexpr int across = 4; // directions: an image's pixels, or a smooth sum, are about as fine
    std::vector<double> texels(cubeTexels(side));
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = Texel(i, side).mean(across, [&](const glm::dvec3& direction) { return radiance(sky, direction); });
    return texels;
}

/// The share of each texel that the sun covers, as the texels' numbers and shares.
std::vector<double> coverage(const Sun& sun, int side) {
    constexpr int across = 16;                                          // of a texel that the sun's edge may cross
    const double reach = 0.5 * glm::radians(sun.diameter) + 2.0 / side; // a texel's corners are no farther from its middle
    const double nearest = reach < glm::pi<double>() ? std::cos(reach) : -1.0;
    std::vector<double> shares(cubeTexels(side));
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const Texel texel(i, side);
        if (glm::dot(texel.middle(), sun.direction) < nearest) continue;
        shares[i] = texel.mean(across, [&](const glm::dvec3& direction) { return sun.contains(direction) ? 1.0 : 0.0; });
    }
    return shares;
}

std::size_t texelOf(const glm::dvec3& direction, int side) {
    const CubePoint point = cubePointOf(direction);
    const glm::ivec2 cell = glm::min(glm::ivec2(0.5 * (point.at + 1.0) * static_cast<double>(side)), side - 1);
    return (static_cast<std::size_t>(point.face) * static_cast<std::size_t>(side) + static_cast<std::size_t>(cell.y)) *
               static_cast<std::size_t>(side) +
           static_cast<std::size_t>(cell.x);
}

void addSun(std::vector<double>& texels, const Sun& sun, int side) {
    std::vector<double> shares = coverage(sun, side);
    double covered = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) covered += shares[i] * Texel(i, side).angle();
    if (covered == 0) { // between the directions of the grid
        const std::size_t texel = texelOf(sun.direction, side);
        shares[texel] = 1;
        covered = Texel(texel, side).angle();
    }
    const double scale = sun.radiance * sun.solidAngle() / covered;
    for (std::size_t i = 0; i < shares.size(); ++i) texels[i] += scale * shares[i];
}

} // namespace

std::vector<double> cubeLight(const EnvironmentLight& light, int side) {
    std::vector<double> texels = skyTexels(light.sky, side);
    for (const Sun& sun : light.suns) addSun(texels, sun, side);
    return texels;
}

} // namespace shadowbench::techniques
