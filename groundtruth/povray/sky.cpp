#include "groundtruth/povray/sky.h"

#include "base/error.h"
#include "base/parallel.h"
#include "groundtruth/povray/channels.h"
#include "groundtruth/povray/scene_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::povray {
namespace {

using Thirds = std::array<double, 3>;

/// What keeps every light outside the scene: the lights stand on a sphere about it.
struct Sphere {
    glm::dvec3 centre{0};
    double radius = 1;
};

Sphere sphereAround(const Snapshot& snapshot) {
    const Bounds bounds = snapshot.bounds();
    if (bounds.empty()) return {};
    return {bounds.centre(), glm::distance(bounds.low, bounds.high)}; // twice as far out as the scene reaches
}

double farthestCoordinate(const Sphere& sphere) {
    const glm::dvec3 centre = glm::abs(sphere.centre);
    return std::max({centre.x, centre.y, centre.z}) + sphere.radius;
}

double scaleUnderSky(const Snapshot& snapshot, const SkyRecipe& recipe) {
    return scaleFor(snapshot, farthestCoordinate(sphereAround(snapshot)), recipe.largestScale);
}

void requireSamples(int samples) {
    if (samples < fewestLightSamples || samples > mostLightSamples)
        throw BadInput(
            fmt::format("{} directions of the sky asked for: give {} to {}", samples, fewestLightSamples, mostLightSamples));
}

/// E₀ of the three parts of the lights.
Thirds unoccluded(const std::vector<ParallelLight>& lights, const glm::dvec3& normal) {
    Thirds sums{};
    for (const ParallelLight& light : lights)
        sums[light.third] += light.irradiance * irradianceWeight(light.towards, normal);
    return sums;
}

Image<Thirds> unoccluded(const std::vector<ParallelLight>& lights, const Image<glm::dvec3>& normals, int threads) {
    Image<Thirds> result(normals.width(), normals.height(), Thirds{});
    inParallel(normals.height(), threads, [&](int y) {
        for (int x = 0; x < normals.width(); ++x)
            if (normals(x, y) != glm::dvec3(0)) result(x, y) = unoccluded(lights, normals(x, y));
    });
    return result;
}

Thirds largest(const Image<Thirds>& unoccluded) {
    Thirds most{};
    for (const Thirds& sums : unoccluded)
        for (std::size_t third = 0; third < most.size(); ++third) most[third] = std::max(most[third], sums[third]);
    return most;
}

/// The share of the irradiance of the first `thirds` parts that arrives. What 16 bits leave of nothing and of all is made
/// exact again.
float share(const Thirds& arriving, const Thirds& all, const Thirds& full, std::size_t thirds) {
    constexpr double step = 1.0 / 65535;
    double e = 0, e0 = 0, rounding = 0;
    for (std::size_t third = 0; third < thirds; ++third) {
        e += arriving[third];
        e0 += all[third];
        rounding += (third == 2 ? 2 : 1) * step * full[third]; // blue has half the steps
    }
    if (e <= rounding) return 0;
    if (e >= e0 - rounding) return 1;
    return static_cast<float>(e / e0);
}

} // namespace

std::vector<int> directionCounts(const SkySampler& sampler, int samples) {
    std::vector<int> counts;
    const std::size_t parts = sampler.parts();
    const auto suns = static_cast<int>(parts) - (parts > 0 && !sampler.isSun(0) ? 1 : 0);
    const bool both = suns > 0 && static_cast<std::size_t>(suns) < parts;
    const int share = both ? samples / 2 : samples;
    for (std::size_t part = 0; part < parts; ++part)
        counts.push_back(sampler.isSun(part) ? std::max(fewestOfASun, share / suns) : share);
    return counts;
}

std::vector<ParallelLight> parallelLights(const EnvironmentLight& environment, int samples) {
    const SkySampler sampler(environment);
    const std::vector<int> counts = directionCounts(sampler, samples);
    std::vector<ParallelLight> lights;
    for (std::size_t part = 0; part < counts.size(); ++part) {
        const int count = counts[part];
        const SampleParts parts = sampleParts(count);
        for (int i = 0; i < count; ++i) {
            const SkyDirection drawn = sampler.at(part, lightSample(i, count, static_cast<std::uint32_t>(part)));
            const std::size_t third = i < parts.firstQuarter ? 0 : i < parts.firstQuarter + parts.secondQuarter ? 1 : 2;
            lights.push_back({drawn.towards, drawn.irradiance / count, third});
        }
    }
    return lights;
}

std::string skyText(const Snapshot& snapshot, glm::ivec2 size, const std::vector<ParallelLight>& lights,
                    const std::array<double, 3>& full, const SkyRecipe& recipe) {
    const double scale = scaleUnderSky(snapshot, recipe);
    const Sphere sphere = sphereAround(snapshot);
    Text text;
    addScene(text, snapshot, size, {scale, recipe.brilliance, recipe.doubleIlluminate});
    add(text, "#declare C = {};\n", vector(scale * sphere.centre));
    for (const ParallelLight& light : lights) {
        if (!(light.irradiance > 0)) continue;
        glm::dvec3 colour(0);
        colour[static_cast<int>(light.third)] = (light.third == 2 ? 1 - hitMask : 1) * light.irradiance / full[light.third];
        add(text, "light_source {{ {} rgb {} parallel point_at C }}\n",
            vector(scale * (sphere.centre + sphere.radius * light.towards)), vector(colour));
    }
    return fmt::to_string(text);
}

SkyRender renderSky(const Snapshot& snapshot, int samples, const Image<glm::dvec3>& normals, const Options& options,
                    const SkyRecipe& recipe, const Progress& progress) {
    requireSamples(samples);
    const glm::ivec2 size(normals.width(), normals.height());
    const std::vector<ParallelLight> lights = parallelLights(*snapshot.light.environment, samples);
    const Image<Thirds> all = unoccluded(lights, normals, options.threads);
    Thirds full = largest(all);
    const double brightest = full[0] + full[1] + full[2];
    for (double& one : full) one = one > 0 ? one : 1; // nothing that is seen is lit

    const Channels channels = renderChannels(skyText(snapshot, size, lights, full, recipe), size, options, progress);
    SkyRender result{{Image<float>(size.x, size.y, 0), Image<float>(size.x, size.y, 0), Image<float>(size.x, size.y, 0),
                      channels.hit, scaleUnderSky(snapshot, recipe)},
                     Image<double>(size.x, size.y, 0)};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double e0 = all[i][0] + all[i][1] + all[i][2];
        if (!(e0 > 0)) continue;
        const Thirds arriving{full[0] * static_cast<double>(channels.red[i]),
                              full[1] * static_cast<double>(channels.green[i]),
                              full[2] * static_cast<double>(channels.blue[i]) / (1 - hitMask)};
        result.unoccluded[i] = e0 / brightest;
        result.image.visible[i] = share(arriving, all[i], full, 3);
        result.image.firstHalf[i] = share(arriving, all[i], full, 2);
        result.image.firstQuarter[i] = share(arriving, all[i], full, 1);
    }
    return result;
}

} // namespace shadowbench::groundtruth::povray
