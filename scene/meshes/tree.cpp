// The procedural tree: a trunk, branches to the balls of the crown, and leaves that are closed diamonds.
#include "base/random.h"
#include "scene/meshes/procedural.h"
#include "scene/meshes/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace shadowbench {
namespace {

struct Ball {
    glm::dvec3 centre;
    double radius;
};

constexpr double kFoot = 0.05; // metres that the trunk reaches into the ground: no face lies in the ground's own plane
constexpr int kBalls = 7;
constexpr int kTrianglesOfALeaf = 4;
constexpr double kLeafArea = 8.0; // m² of all leaves together, at every level

/// One ball on top and six around, the same at every level of detail.
std::array<Ball, kBalls> crownOf(std::uint32_t seed) {
    Random random(seed);
    std::array<Ball, kBalls> crown;
    crown[0] = {{random.uniform(-0.12, 0.12), random.uniform(2.25, 2.4), random.uniform(-0.12, 0.12)}, 0.62};
    const double start = random.uniform(0, glm::two_pi<double>());
    for (int i = 1; i < kBalls; ++i) {
        const double angle = start + glm::two_pi<double>() * (i + random.uniform(-0.2, 0.2)) / (kBalls - 1);
        const double reach = random.uniform(0.48, 0.66);
        const double height = (i % 2 == 0 ? 1.45 : 1.85) + random.uniform(-0.12, 0.12);
        crown[static_cast<std::size_t>(i)] = {{reach * std::cos(angle), height, reach * std::sin(angle)},
                                              random.uniform(0.42, 0.54)};
    }
    return crown;
}

/// Trunk, and branches where the triangles allow: about an eighth of them, at most as many as look round.
Mesh wood(int triangles, const std::array<Ball, kBalls>& crown) {
    const int budget = triangles / 8;
    const int branches = budget >= 4 * 8 ? kBalls - 1 : 0;
    const int sides = std::clamp((budget / (branches + 2) + 4) / 4, 3, 24);
    Mesh mesh{{}, {}, true};
    append(mesh, rod({0, -kFoot, 0}, crown[0].centre, 0.13, 0.04, std::max(sides, std::min(2 * sides, budget / 8))));
    for (int i = 1; i <= branches; ++i) {
        const Ball& ball = crown[static_cast<std::size_t>(i)];
        const double fork = 0.55 * ball.centre.y / crown[0].centre.y;
        append(mesh, rod(fork * crown[0].centre, ball.centre, 0.055, 0.02, sides));
    }
    return mesh;
}

/// Leaf number `i` of a tree: fewer leaves are the first ones of more, each larger.
Mesh leaf(int i, double length, const std::array<Ball, kBalls>& crown, std::uint32_t seed) {
    Random random((static_cast<std::uint64_t>(seed) << 32U) + static_cast<std::uint64_t>(i));
    const Ball& ball = crown[static_cast<std::size_t>(i % kBalls)];
    const glm::dvec3 outward = directionOf(random.uniform(), random.uniform());
    const double depth = std::cbrt(random.uniform(0.15, 1));
    const glm::dvec3 middle = ball.centre + std::max(0.3 * ball.radius, ball.radius - 0.35 * length) * depth * outward;
    const glm::dvec3 along = glm::normalize(directionOf(random.uniform(), random.uniform()) + 0.7 * outward);
    const glm::dvec3 other = directionOf(random.uniform(), random.uniform());
    const glm::dvec3 across = glm::cross(along, other);
    if (glm::length(across) < 1e-3) return leaf(i + kBalls * 1000003, length, crown, seed); // parallel: draw again
    const glm::dvec3 side = 0.3 * length * glm::normalize(across);
    return foldedLeaf(middle - 0.5 * length * along, middle + 0.5 * length * along, side, 0.08 * length);
}

} // namespace

Mesh tree(int triangles, std::uint32_t seed) {
    const auto crown = crownOf(seed);
    Mesh mesh = wood(triangles, crown);
    const int leaves = std::max(kBalls, (triangles - static_cast<int>(mesh.triangles.size())) / kTrianglesOfALeaf);
    const double length = std::sqrt(kLeafArea / (0.3 * leaves)); // a leaf is a diamond of 1 : 0.6
    for (int i = 0; i < leaves; ++i) append(mesh, leaf(i, length, crown, seed));
    return mesh;
}

} // namespace shadowbench
