// Visibility under an environment light by POV-Ray: many parallel lights, whose cosines the diffuse term takes
// (docs/ground-truth.md, "Environment light").
#pragma once

#include "groundtruth/povray/povray.h"
#include "scene/sky_sampler.h"

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench::groundtruth::povray {

/// Raise it with every change that can alter a pixel under an environment light: it is part of the key of each.
constexpr int skyCodeVersion = 1;

/// However few directions are asked for, a sun gets so many.
constexpr int fewestOfASun = 256;

/// How many of `samples` directions each part of the light gets (SkySampler::parts): half of them the sky and half all suns
/// together, or all of them what there is alone.
std::vector<int> directionCounts(const SkySampler& sampler, int samples);

/// A parallel light: what it brings to a surface that faces it, and the part of the sample set that it belongs to (0 and 1:
/// the quarters of the first half; 2: the second half).
struct ParallelLight {
    glm::dvec3 towards;
    double irradiance;
    std::size_t third;
};

/// The environment as parallel lights: each part of it at the points of a low-discrepancy set (lightSample) of its own.
std::vector<ParallelLight> parallelLights(const EnvironmentLight& environment, int samples);

/// How the scene is written for POV-Ray. Other values than the defaults give wrong images, for tests that show that a
/// certificate rejects them.
struct SkyRecipe {
    double brilliance = 1;         // of the cosine
    bool doubleIlluminate = false; // light from below the tangent plane counts
    double largestScale = 1024;    // POV-Ray units per world unit
};

/// The scene text: red, green and blue hold the irradiance from the three parts of `lights` in units of `full`, blue half of
/// it beside the hit mask.
std::string skyText(const Snapshot& snapshot, glm::ivec2 size, const std::vector<ParallelLight>& lights,
                    const std::array<double, 3>& full, const SkyRecipe& recipe = {});

struct SkyRender {
    Render image;             // of E/E₀; 0 where E₀ is 0 or there is no surface
    Image<double> unoccluded; // E₀ as a share of the largest in the image
};

/// Renders the snapshot, whose light is an environment. `normals` are those that the pixels see, unit length and on the side
/// of the eye, 0 where there is no surface: E₀ is summed up over the same lights. Throws as `render`, and BadInput for
/// samples outside [fewestLightSamples, mostLightSamples].
SkyRender renderSky(const Snapshot& snapshot, int samples, const Image<glm::dvec3>& normals, const Options& options = {},
                    const SkyRecipe& recipe = {}, const Progress& progress = {});

} // namespace shadowbench::groundtruth::povray
