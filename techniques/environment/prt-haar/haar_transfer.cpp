#include "techniques/environment/prt-haar/haar_transfer.h"

#include "base/parallel.h"
#include "techniques/environment/haar.h"
#include "techniques/environment/point_tracing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace shadowbench::techniques {
namespace {

StoredTransfer stored(const glm::dvec3& normal, std::span<const DirectionSample> directions,
                      std::span<const std::uint8_t> blocked, int side, double least) {
    std::vector<double> cube(cubeTexels(side));
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double cosine = glm::dot(normal, glm::dvec3(directions[i].direction));
        if (cosine > 0 && blocked[i] == 0) cube[directions[i].texel] += directions[i].solidAngle * cosine;
    }
    haarTransform(cube, side);
    const auto count = static_cast<std::size_t>(std::ranges::count_if(cube, [&](double x) { return std::abs(x) >= least; }));
    StoredTransfer result;
    result.numbers.reserve(count);
    result.values.reserve(count);
    for (std::size_t i = 0; i < cube.size(); ++i) {
        if (std::abs(cube[i]) < least) continue;
        result.numbers.push_back(static_cast<std::uint16_t>(i));
        result.values.push_back(static_cast<float>(cube[i]));
    }
    return result;
}

} // namespace

std::vector<StoredTransfer> haarTransfer(const SurfacePoints& points, const Snapshot& snapshot,
                                         std::span<const DirectionSample> directions, int side, double least) {
    std::vector<StoredTransfer> transfer(points.points.size());
    const auto sources =
        tracePoints(points, snapshot, directions, [&](std::size_t point, std::span<const std::uint8_t> blocked) {
            transfer[point] = stored(points.points[point].normal, directions, blocked, side, least);
        });
    for (std::size_t i = 0; i < transfer.size(); ++i)
        if (sources[i] != i) transfer[i] = transfer[sources[i]];
    return transfer;
}

std::vector<float> chosenCoefficients(std::span<const StoredTransfer> vectors, std::span<const std::size_t> chosen) {
    std::vector<std::size_t> ascending(chosen.size()); // places in `chosen`
    std::iota(ascending.begin(), ascending.end(), std::size_t{0});
    std::ranges::sort(ascending, {}, [&](std::size_t i) { return chosen[i]; });
    std::vector<float> result(chosen.size() * vectors.size());
    inParallelParts(vectors.size(), availableThreads(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t vector = begin; vector < end; ++vector) {
            const StoredTransfer& from = vectors[vector];
            std::size_t at = 0;
            for (const std::size_t i : ascending) {
                while (at < from.numbers.size() && from.numbers[at] < chosen[i]) ++at;
                if (at < from.numbers.size() && from.numbers[at] == chosen[i])
                    result[i * vectors.size() + vector] = from.values[at];
            }
        }
    });
    return result;
}

std::vector<float> unshadowedIrradiance(std::span<const PointPatch> patches, std::span<const DirectionSample> directions,
                                        std::span<const double> texels) {
    std::vector<float> result(patches.size());
    inParallelParts(patches.size(), availableThreads(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t patch = begin; patch < end; ++patch) {
            double sum = 0;
            for (const DirectionSample& sample : directions)
                sum += texels[sample.texel] * sample.solidAngle *
                       std::max(0.0, glm::dot(patches[patch].normal, glm::dvec3(sample.direction)));
            result[patch] = static_cast<float>(sum);
        }
    });
    return result;
}

} // namespace shadowbench::techniques
