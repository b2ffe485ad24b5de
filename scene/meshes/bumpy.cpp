// The bumpy mesh: a geodesic sphere displaced along its radii, hence star-shaped and free of self-intersection.
#include "base/random.h"
#include "scene/meshes/primitives.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowbench {
namespace {

/// Value of the noise lattice at integer coordinates, in [−1, 1).
double latticeValue(const glm::ivec3& cell, std::uint32_t seed) {
    std::uint64_t h = seed;
    for (int axis = 0; axis < 3; ++axis) h = mixBits(h ^ static_cast<std::uint32_t>(cell[axis]));
    return 2 * hashed(h) - 1;
}

/// Value noise with a quintic fade (twice continuously differentiable), in [−1, 1). Only +, − and ×: the same on every
/// machine.
double valueNoise(const glm::dvec3& p, std::uint32_t seed) {
    const glm::dvec3 cell = glm::floor(p);
    const glm::dvec3 f = p - cell;
    const glm::dvec3 fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= step[axis] == 1 ? fade[axis] : 1 - fade[axis];
        sum += weight * latticeValue(glm::ivec3(cell) + step, seed);
    }
    return sum;
}

} // namespace

Mesh bumpy(double radius, double bump, int triangles, std::uint32_t seed) {
    constexpr double kCoarse = 2.3, kFine = 5.1; // bumps per radius, neither a whole multiple of the other
    Mesh mesh = sphere(1, triangles);
    for (glm::vec3& position : mesh.positions) {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(position));
        const double noise = 0.7 * valueNoise(kCoarse * direction, seed) + 0.3 * valueNoise(kFine * direction, ~seed);
        position = glm::vec3((radius + bump * noise) * direction);
    }
    return mesh;
}

} // namespace shadowbench
