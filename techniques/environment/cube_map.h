// The sphere of directions as the texels of a cube map: six faces of side × side, numbered face by face, row by row.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench::techniques {

/// Face 2·axis looks along the positive axis, face 2·axis + 1 along the negative one; `at` in [−1, 1]² runs along the two
/// axes that follow.
struct CubePoint {
    int face;
    glm::dvec2 at;
};

glm::dvec3 directionOf(const CubePoint& point); // unit length
CubePoint cubePointOf(const glm::dvec3& direction);

/// The solid angle of the part of a face between `low` and `high`.
double solidAngle(const glm::dvec2& low, const glm::dvec2& high);

/// A direction that stands for a part of the sphere.
struct DirectionSample {
    glm::vec3 direction; // unit length
    double solidAngle;   // of that part
    std::size_t texel;   // of the cube map that holds the part; 0 for samples of the whole sphere
};

inline std::size_t cubeTexels(int side) { return 6 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side); }

/// `across` × `across` directions in each texel of a cube map, each at a pseudo-random place of its own cell: straight edges
/// along the faces' rows are hit one after the other, not a whole row at once.
std::vector<DirectionSample> cubeSamples(int side, int across);

/// `count` directions of equal solid angle, the points of a spherical Fibonacci lattice; neighbours lie close to each other
/// in the list.
std::vector<DirectionSample> evenSamples(int count);

} // namespace shadowbench::techniques
