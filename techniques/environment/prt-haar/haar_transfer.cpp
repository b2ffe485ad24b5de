#include "techniques/environment/prt-haar/haar_transfer.h"

#include "techniques/environment/haar.h"
#include "techniques/environment/point_tracing.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

/// Writes the transformed transfer of one vector; `blocked` may be empty: nothing is.
void writeTransfer(const glm::dvec3& normal, std::span<const DirectionSample> directions,
                   std::span<const std::uint8_t> blocked, int side, std::span<float> out) {
    std::vector<double> cube(cubeTexels(side));
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double cosine = glm::dot(normal, glm::dvec3(directions[i].direction));
        if (cosine > 0 && (blocked.empty() || blocked[i] == 0))
            cube[directions[i].texel] += directions[i].solidAngle * cosine;
    }
    haarTransform(cube, side);
    std::ranges::transform(cube, out.begin(), [](double x) { return static_cast<float>(x); });
}

} // namespace

std::vector<float> haarTransfer(const SurfacePoints& points, const Snapshot& snapshot,
                                std::span<const DirectionSample> directions, int side) {
    const std::size_t size = cubeTexels(side), count = points.points.size();
    std::vector<float> transfer((count + points.patches.size()) * size);
    const auto vector = [&](std::size_t i) { return std::span(transfer).subspan(i * size, size); };
    const auto sources =
        tracePoints(points, snapshot, directions, [&](std::size_t point, std::span<const std::uint8_t> blocked) {
            writeTransfer(points.points[point].normal, directions, blocked, side, vector(point));
        });
    for (std::size_t i = 0; i < count; ++i)
        if (sources[i] != i) std::ranges::copy(vector(sources[i]), vector(i).begin());
    for (std::size_t i = 0; i < points.patches.size(); ++i)
        writeTransfer(points.patches[i].normal, directions, {}, side, vector(count + i));
    return transfer;
}

std::vector<float> chosenCoefficients(std::span<const float> vectors, std::size_t size,
                                      std::span<const std::size_t> chosen) {
    const std::size_t count = vectors.size() / size;
    std::vector<float> result(chosen.size() * count);
    for (std::size_t vector = 0; vector < count; ++vector)
        for (std::size_t i = 0; i < chosen.size(); ++i) result[i * count + vector] = vectors[vector * size + chosen[i]];
    return result;
}

} // namespace shadowbench::techniques
