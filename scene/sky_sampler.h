// Directions that an environment light is sampled at.
#pragma once

#include "scene/sky.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

namespace shadowbench {

/// A direction that light comes from, and the irradiance that it brings to a surface that faces it.
struct SkyDirection {
    glm::dvec3 towards;
    double irradiance;
};

/// Draws directions. The light comes in parts, each sampled apart: first the sky, unless it is black, then the suns.
class SkySampler {
public:
    explicit SkySampler(const EnvironmentLight& light);
    ~SkySampler();
    SkySampler(const SkySampler&) = delete;
    SkySampler& operator=(const SkySampler&) = delete;

    [[nodiscard]] std::size_t parts() const;
    [[nodiscard]] bool isSun(std::size_t part) const;

    /// The direction of `part` for parameters in [0, 1)²; its irradiance is the part's radiance there over the density of
    /// directions, so that its mean over the square is ∫ L dω. Equal areas of the square hold equal shares of that integral:
    /// exactly in constant skies, images and suns, nearly in harmonics. Rows and columns of the square stay in order, so
    /// what is spread evenly over it is spread evenly over the light.
    [[nodiscard]] SkyDirection at(std::size_t part, const glm::dvec2& st) const;

private:
    class Part;
    class WholeSphere;
    class Rows;
    class Disk;
    std::vector<std::unique_ptr<const Part>> parts_;
    bool hasSky_ = false;
};

} // namespace shadowbench
