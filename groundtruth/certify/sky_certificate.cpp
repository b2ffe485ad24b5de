#include "groundtruth/certify/sky_certificate.h"

#include "base/error.h"
#include "base/random.h"
#include "groundtruth/povray/sky.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <memory>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

/// Sets of the sequence that no render uses: it has fewer parts of light.
constexpr std::uint32_t ownSets = 1U << 20;

/// The points of one part of the light, in the order of the sequence, without a shift.
struct PartPoints {
    std::size_t part;
    std::vector<glm::dvec2> points;
};

std::vector<PartPoints> pointsOf(const SkySampler& sampler, int directions) {
    std::vector<PartPoints> all;
    const std::vector<int> counts = povray::directionCounts(sampler, directions);
    for (std::size_t part = 0; part < counts.size(); ++part) {
        PartPoints& added = all.emplace_back(PartPoints{part, {}});
        for (int i = 0; i < counts[part]; ++i)
            added.points.push_back(povray::lightSample(i, counts[part], ownSets + static_cast<std::uint32_t>(part)));
    }
    return all;
}

/// All points moved by one random vector of each part, round the square (Cranley and Patterson 1976).
std::vector<SkyDirection> shiftedDirections(const SkySampler& sampler, const std::vector<PartPoints>& parts,
                                            std::uint64_t seed) {
    Random random(seed);
    std::vector<SkyDirection> directions;
    for (const PartPoints& part : parts) {
        const double s = random.uniform(), t = random.uniform();
        for (const glm::dvec2& point : part.points) {
            SkyDirection drawn = sampler.at(part.part, glm::fract(point + glm::dvec2(s, t)));
            drawn.irradiance /= static_cast<double>(part.points.size());
            directions.push_back(drawn);
        }
    }
    return directions;
}

[[noreturn]] void rejectSky(const std::string& what) {
    throw Inconclusive(
        fmt::format("POV-Ray's shadows were compared with exact directions of the sky and rejected: {}; ask for "
                    "more samples, and report this scene if that does not help",
                    what));
}

} // namespace

ExactFraction exactSkyShare(const hard::ExactSky& scene, const EnvironmentLight& light, const PrimaryHits& primary,
                            int directions) {
    const auto sampler = std::make_shared<const SkySampler>(light);
    const auto points = std::make_shared<const std::vector<PartPoints>>(pointsOf(*sampler, directions));
    return [&scene, &primary, sampler, points](glm::ivec2 pixel) -> area::VisibleFraction {
        const std::uint64_t seed = (static_cast<std::uint64_t>(pixel.y) << 32) | static_cast<std::uint32_t>(pixel.x);
        const hard::Irradiance found = scene.irradiance(pixel, primary, shiftedDirections(*sampler, *points, seed));
        const double share = found.unoccluded > 0 ? found.arriving / found.unoccluded : 0;
        return {share, share};
    };
}

Certificate certifySky(const hard::ExactSky& scene, const EnvironmentLight& light, const povray::Render& image,
                       const PrimaryHits& primary, int samples, int points, int threads, const Progress& progress) {
    Certificate certificate =
        certify(image, primary, samples, points, threads, exactSkyShare(scene, light, primary), progress);
    certificate.uneven = 0;
    return certificate;
}

void requireSkyCertified(const Certificate& c, int samples) {
    constexpr double mostBias = 0.001, mostRms = 0.005;
    constexpr int fewestPartlyLit = 32; // the rms of 32 is known to an eighth
    if (c.wrong > 0)
        rejectSky(fmt::format("{} of {} points are fully lit or fully shadowed and should not be", c.wrong, c.points));
    if (c.penumbra < fewestPartlyLit) return;

    const double fewer = std::pow(std::max(1.0, static_cast<double>(usualDirections) / samples), 0.75);
    if (std::abs(c.bias) > fewer * mostBias)
        rejectSky(fmt::format("its mean error over {} partly lit points is {:.4f}, more than {:.4f}", c.penumbra, c.bias,
                              fewer * mostBias));
    if (c.rms > fewer * mostRms)
        rejectSky(fmt::format("its rms error over {} partly lit points is {:.4f}, more than {:.4f}", c.penumbra, c.rms,
                              fewer * mostRms));
    if (c.rms > std::max(0.75 * c.rmsQuarter, 0.2 * fewer * mostRms))
        rejectSky(
            fmt::format("its rms error does not fall with the number of directions: {:.4f} with a quarter of them, {:.4f} "
                        "with all {}",
                        c.rmsQuarter, c.rms, samples));
}

} // namespace shadowbench::groundtruth
