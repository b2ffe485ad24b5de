// Certificates of renders that the N-sample oracle makes: exact visibility of other sample sets at the points of a
// certificate, without POV-Ray.
#pragma once

#include "base/parallel.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/cgal/hard/exact.h"

#include <cmath>
#include <vector>

namespace shadowbench::groundtruth {

inline std::vector<std::vector<glm::dvec2>> seedSets(int samples, int seeds) {
    const int quarter = povray::sampleParts(samples).firstQuarter;
    std::vector<std::vector<glm::dvec2>> sets;
    for (int seed = 1; seed <= seeds; ++seed) {
        std::vector<glm::dvec2> first, rest;
        for (int i = 0; i < samples; ++i)
            (i < quarter ? first : rest).push_back(povray::lightSample(i, samples, static_cast<std::uint32_t>(seed)));
        sets.push_back(first);
        sets.push_back(rest);
    }
    return sets;
}

/// Certificates of the sets 1 … `seeds` at `pixels`, all with the bounds that `honest` has.
inline std::vector<Certificate> certificatesOfSeeds(const area::AreaScene& scene, const Request& request,
                                                    const PrimaryHits& primary, const std::vector<glm::ivec2>& pixels,
                                                    const HonestBounds& honest, int seeds) {
    const area::LightPoints points(request.snapshot.light.kind, seedSets(request.samples, seeds));
    std::vector<area::SampledFraction> found(pixels.size());
    inParallel(static_cast<int>(pixels.size()), availableThreads(), [&](int i) {
        const auto index = static_cast<std::size_t>(i);
        found[index] = scene.sampledFraction(pixels[index], request.size, primary, points);
    });
    std::vector<Certificate> certificates(static_cast<std::size_t>(seeds));
    for (std::size_t seed = 0; seed < certificates.size(); ++seed) {
        Certificate& c = certificates[seed];
        for (const area::SampledFraction& at : found) {
            const double truth = (at.fraction.low + at.fraction.high) / 2;
            if (truth <= 0 || truth >= 1 || at.fraction.high - at.fraction.low > 0.01) continue;
            const int quarter = at.visible[2 * seed], rest = at.visible[2 * seed + 1];
            const double error = static_cast<double>(quarter + rest) / request.samples - truth;
            const double ofQuarter = static_cast<double>(quarter) / points.sizes()[0] - truth;
            ++c.penumbra;
            c.bias += error;
            c.rms += error * error;
            c.rmsQuarter += ofQuarter * ofQuarter;
        }
        c.points = c.penumbra;
        c.bias /= c.penumbra;
        c.rms = std::sqrt(c.rms / c.penumbra);
        c.rmsQuarter = std::sqrt(c.rmsQuarter / c.penumbra);
        c.honest = honest;
    }
    return certificates;
}

} // namespace shadowbench::groundtruth
