#include "techniques/environment/prt-sh/harmonic_transfer.h"

#include "techniques/environment/harmonic_light.h"
#include "techniques/environment/point_tracing.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

/// The basis functions in each direction, times the solid angle that it stands for.
std::vector<ShVector> weightedBasis(std::span<const DirectionSample> directions) {
    std::vector<ShVector> basis;
    for (const DirectionSample& sample : directions) {
        basis.push_back(shBasis(glm::dvec3(sample.direction)));
        for (double& value : basis.back()) value *= sample.solidAngle;
    }
    return basis;
}

} // namespace

std::vector<float> harmonicTransfer(const SurfacePoints& points, const Snapshot& snapshot,
                                    std::span<const DirectionSample> directions, std::size_t coefficients) {
    const std::vector<ShVector> basis = weightedBasis(directions);
    const std::size_t count = points.points.size();
    std::vector<float> transfer((count + points.patches.size()) * coefficients);
    const auto set = [&](std::size_t vector, const ShVector& values) {
        for (std::size_t i = 0; i < coefficients; ++i)
            transfer[vector * coefficients + i] = static_cast<float>(values.at(i));
    };
    const auto sources =
        tracePoints(points, snapshot, directions, [&](std::size_t point, std::span<const std::uint8_t> blocked) {
            const glm::dvec3& normal = points.points[point].normal;
            ShVector vector = unshadowedTransfer(normal);
            for (std::size_t i = 0; i < directions.size(); ++i) {
                if (blocked[i] == 0) continue;
                const double cosine = glm::dot(normal, glm::dvec3(directions[i].direction));
                for (std::size_t k = 0; k < coefficients; ++k) vector.at(k) -= cosine * basis[i].at(k);
            }
            set(point, vector);
        });
    for (std::size_t i = 0; i < count; ++i)
        if (sources[i] != i) std::copy_n(&transfer[sources[i] * coefficients], coefficients, &transfer[i * coefficients]);
    for (std::size_t i = 0; i < points.patches.size(); ++i) set(count + i, unshadowedTransfer(points.patches[i].normal));
    return transfer;
}

} // namespace shadowbench::techniques
