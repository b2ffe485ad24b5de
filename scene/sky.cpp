#include "scene/sky.h"

#include "scene/spherical_harmonics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <numbers>
#include <utility>

namespace shadowbench {
namespace {

/// ∫ L (ω, 1) dω of each kind of sky.
struct Moments {
    glm::dvec4 operator()(const ConstantSky& sky) const { return {0, 0, 0, 4 * std::numbers::pi * sky.radiance}; }

    /// The functions of degree 0 and 1 are √(1/4π) and √(3/4π) (y, z, x), those of all other degrees orthogonal to them.
    glm::dvec4 operator()(const HarmonicSky& sky) const {
        const std::vector<double>& c = sky.coefficients;
        const double all = std::sqrt(4 * std::numbers::pi) * c[0];
        if (c.size() < 4) return {0, 0, 0, all};
        return {std::sqrt(4 * std::numbers::pi / 3) * glm::dvec3(c[3], c[1], c[2]), all};
    }

    glm::dvec4 operator()(const ImageSky& sky) const {
        const int width = sky.radiance.width(), height = sky.radiance.height();
        glm::dvec4 sum(0);
        for (int y = 0; y < height; ++y) {
            const double solidAngle = std::sin(std::numbers::pi * (y + 0.5) / height) * 2 * std::numbers::pi *
                                      std::numbers::pi / (static_cast<double>(width) * height);
            for (int x = 0; x < width; ++x)
                sum +=
                    solidAngle * static_cast<double>(sky.radiance(x, y)) * glm::dvec4(sky.direction({x + 0.5, y + 0.5}), 1);
        }
        return sum;
    }
};

/// A cap of angular radius r has ∫ ω dω = π sin² r along its axis.
glm::dvec4 momentsOf(const Sun& sun) {
    const double sine = std::sin(0.5 * glm::radians(sun.diameter));
    return sun.radiance * glm::dvec4(std::numbers::pi * sine * sine * sun.direction, sun.solidAngle());
}

} // namespace

glm::dvec3 ImageSky::direction(const glm::dvec2& position) const {
    const double latitude = std::numbers::pi * (0.5 - position.y / radiance.height());
    const double longitude = std::numbers::pi * (1 - 2 * position.x / radiance.width());
    return {std::cos(latitude) * std::sin(longitude), std::sin(latitude), std::cos(latitude) * std::cos(longitude)};
}

glm::ivec2 ImageSky::pixel(const glm::dvec3& direction) const {
    const double latitude = std::asin(std::clamp(direction.y, -1.0, 1.0));
    const double longitude = std::atan2(direction.x, direction.z);
    const glm::ivec2 size(radiance.width(), radiance.height());
    const glm::dvec2 position(0.5 * (1 - longitude * std::numbers::inv_pi) * size.x,
                              (0.5 - latitude * std::numbers::inv_pi) * size.y);
    return glm::clamp(glm::ivec2(glm::floor(position)), glm::ivec2(0), size - 1);
}

bool Sun::contains(const glm::dvec3& towards) const {
    return glm::dot(towards, direction) >= std::cos(0.5 * glm::radians(diameter));
}

/// 2π (1 − cos r) of the angular radius r, without the difference that cancels.
double Sun::solidAngle() const {
    const double half = std::sin(0.25 * glm::radians(diameter));
    return 4 * std::numbers::pi * half * half;
}

double radiance(const Sky& sky, const glm::dvec3& direction) {
    if (const auto* constant = std::get_if<ConstantSky>(&sky)) return constant->radiance;
    if (const auto* smooth = std::get_if<HarmonicSky>(&sky))
        return std::max(0.0, harmonicSum(smooth->coefficients, direction));
    const auto& image = std::get<ImageSky>(sky);
    const glm::ivec2 pixel = image.pixel(direction);
    return static_cast<double>(image.radiance(pixel.x, pixel.y));
}

double irradianceWeight(const glm::dvec3& direction, const glm::dvec3& normal) {
    return std::max(0.0, glm::dot(direction, normal));
}

glm::dvec3 meanDirection(const EnvironmentLight& light) {
    constexpr double balanced = 1e-9; // of all light: what rounding leaves where opposite directions cancel
    glm::dvec4 sum = std::visit(Moments(), light.sky);
    for (const Sun& sun : light.suns) sum += momentsOf(sun);
    const glm::dvec3 moment(sum);
    return glm::length(moment) > balanced * sum.w ? glm::normalize(moment) : glm::dvec3(0, 1, 0);
}

Light environmentLight(EnvironmentLight environment) {
    Light light;
    light.kind = LightKind::Environment;
    light.direction = -meanDirection(environment);
    light.environment = std::make_shared<const EnvironmentLight>(std::move(environment));
    return light;
}

} // namespace shadowbench
