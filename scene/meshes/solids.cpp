#include "scene/meshes/solids.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace shadowbench {
namespace {

/// Side wall between two rings of `sides` vertices, counter-clockwise seen from their axis' far end.
void addWall(Mesh& mesh, std::uint32_t lower, std::uint32_t upper, std::uint32_t sides) {
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = (i + 1) % sides;
        mesh.triangles.emplace_back(lower + i, lower + next, upper + next);
        mesh.triangles.emplace_back(lower + i, upper + next, upper + i);
    }
}

/// Regular polygon about `centre` in the plane of `x` and `y`, turning from x to y.
void addRing(Mesh& mesh, const glm::dvec3& centre, const glm::dvec3& x, const glm::dvec3& y, std::uint32_t sides) {
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = glm::two_pi<double>() * i / sides;
        mesh.positions.emplace_back(centre + std::cos(angle) * x + std::sin(angle) * y);
    }
}

} // namespace

void append(Mesh& whole, const Mesh& part, const glm::dmat4& place) {
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    for (const glm::vec3& position : part.positions)
        whole.positions.emplace_back(glm::dvec3(place * glm::dvec4(glm::dvec3(position), 1.0)));
    for (const glm::uvec3& t : part.triangles) whole.triangles.push_back(t + first);
}

Mesh rod(const glm::dvec3& a, const glm::dvec3& b, double radiusA, double radiusB, int sides) {
    const glm::dvec3 along = glm::normalize(b - a);
    const glm::dvec3 off = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(off, along));
    const glm::dvec3 y = glm::cross(along, x);
    const auto n = static_cast<std::uint32_t>(sides);
    Mesh mesh{{}, {}, true};
    addRing(mesh, a, radiusA * x, radiusA * y, n);
    addRing(mesh, b, radiusB * x, radiusB * y, n);
    addWall(mesh, 0, n, n);
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
        mesh.triangles.emplace_back(0, i + 1, i);
        mesh.triangles.emplace_back(n, n + i, n + i + 1);
    }
    return mesh;
}

Mesh revolved(double bottom, const std::vector<glm::dvec2>& rings, double top, int sides) {
    const auto n = static_cast<std::uint32_t>(sides);
    Mesh mesh{{}, {}, true};
    for (const glm::dvec2& ring : rings) addRing(mesh, {0, ring.y, 0}, {ring.x, 0, 0}, {0, 0, -ring.x}, n);
    const auto count = static_cast<std::uint32_t>(rings.size());
    for (std::uint32_t i = 0; i + 1 < count; ++i) addWall(mesh, i * n, (i + 1) * n, n);

    const auto lowPole = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0, bottom, 0);
    mesh.positions.emplace_back(0, top, 0);
    const std::uint32_t last = (count - 1) * n;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        mesh.triangles.emplace_back(lowPole, next, i);
        mesh.triangles.emplace_back(lowPole + 1, last + i, last + next);
    }
    return mesh;
}

Mesh foldedLeaf(const glm::dvec3& base, const glm::dvec3& tip, const glm::dvec3& side, double rise) {
    const glm::dvec3 up = rise * glm::normalize(glm::cross(side, tip - base));
    const glm::dvec3 middle = 0.5 * (base + tip) + up;
    return {{glm::vec3(base), glm::vec3(tip), glm::vec3(middle - side), glm::vec3(middle + side)},
            {{0, 1, 3}, {1, 0, 2}, {0, 3, 2}, {1, 2, 3}},
            true};
}

glm::dvec3 directionOf(double s, double t) {
    const double z = 2 * s - 1;
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return {r * std::cos(glm::two_pi<double>() * t), z, r * std::sin(glm::two_pi<double>() * t)};
}

} // namespace shadowbench
