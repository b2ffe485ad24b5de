// An environment light: what arrives from infinitely far away, of a sky and of suns in it. Radiance is one number, the
// luminance in any unit: shadows are shares of light. Directions point away from the scene, towards where the light comes
// from, and have unit length.
#pragma once

#include "base/image.h"
#include "scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <variant>
#include <vector>

namespace shadowbench {

/// The same from every direction, from below the horizon, too.
struct ConstantSky {
    double radiance = 1;
    friend bool operator==(const ConstantSky&, const ConstantSky&) = default;
};

/// A sum of real spherical harmonics (scene/spherical_harmonics.h); their number is a square. What is negative of the sum
/// counts as 0.
struct HarmonicSky {
    std::vector<double> coefficients;
    friend bool operator==(const HarmonicSky&, const HarmonicSky&) = default;
};

/// An equirectangular image, twice as wide as high, as OpenEXR defines latitude–longitude maps: row 0 is the zenith (+y),
/// the middle of a row is +z, a quarter of the width to the left of it +x. A pixel has the same radiance all over.
struct ImageSky {
    Image<float> radiance;
    friend bool operator==(const ImageSky&, const ImageSky&) = default;

    /// Direction of an image position in pixels: (0, y) and (width, y) are the same.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& position) const;
    [[nodiscard]] glm::ivec2 pixel(const glm::dvec3& direction) const; // that holds the direction
};

using Sky = std::variant<ConstantSky, HarmonicSky, ImageSky>;

/// A disk of constant radiance, which is added to that of the sky behind it.
struct Sun {
    glm::dvec3 direction{0, 1, 0}; // towards its centre
    double diameter = 0.53;        // degrees, in (0, 180]: the angle under which the disk is seen
    double radiance = 1;

    [[nodiscard]] bool contains(const glm::dvec3& towards) const;
    [[nodiscard]] double solidAngle() const; // steradians
    friend bool operator==(const Sun&, const Sun&) = default;
};

struct EnvironmentLight {
    Sky sky;
    std::vector<Sun> suns;
    friend bool operator==(const EnvironmentLight&, const EnvironmentLight&) = default;
};

/// Radiance of the sky from `direction`, without suns; ≥ 0.
double radiance(const Sky& sky, const glm::dvec3& direction);

/// The share of the radiance from `direction` that counts as irradiance of a surface with this unit `normal`: the cosine of
/// the angle between them, 0 below the surface's tangent plane.
double irradianceWeight(const glm::dvec3& direction, const glm::dvec3& normal);

/// The mean direction that the light comes from; straight from above where no direction outweighs the others.
glm::dvec3 meanDirection(const EnvironmentLight& light);

/// The light of a scene that is this environment, Light::direction being that of the light on its mean way.
Light environmentLight(EnvironmentLight environment);

} // namespace shadowbench
