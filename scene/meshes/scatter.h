// Fields of instances: a jittered grid that is the same on every machine.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench {

struct Scatter {
    int count = 1;
    glm::dvec2 half{1, 1};      // half sides of the field along x and z, metres
    glm::dvec3 centre{0, 0, 0}; // of the field
    double jitter = 0.6;        // share of a grid cell that an instance may move in: 0 is a regular grid, 1 the whole cell
    glm::dvec2 turn{0, 360};    // range of the turn about y, degrees
    glm::dvec2 scale{1, 1};     // range of the scale
    glm::dvec2 keepOff{0, 0};   // x and z of a spot (the eye) that stays free …
    double clear = 0;           // … within this many metres
    std::uint32_t seed = 1;
};

/// World from object of each instance, row by row. Two fields that differ in nothing but what is placed coincide. Exactly
/// `count` placements: the grid is refined until that many cells are free; none where the field lies within `clear`
/// altogether.
std::vector<glm::dmat4> scattered(const Scatter& scatter);

/// The map of an instance at `at`, turned by `turn` degrees about y and scaled.
glm::dmat4 placed(const glm::dvec3& at, double turn, double scale);

} // namespace shadowbench
