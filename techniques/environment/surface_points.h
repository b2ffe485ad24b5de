// Points spread over the surfaces of a snapshot, each of which gets a transfer vector of its own; a pixel interpolates
// between the four around it.
#pragma once

#include "scene/snapshot.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench::techniques {

/// A point of a surface, on the side that `normal` (unit length) points to.
struct SurfacePoint {
    glm::dvec3 at, normal;
};

/// `steps` + 1 points at equal distances; one in the middle for `steps` = 0.
struct PointRow {
    std::uint32_t first, steps;
};

/// The points of one side of a triangle: `steps` + 1 rows parallel to its shortest edge, from that edge to the corner
/// opposite; one row of one point for a triangle that is smaller than the spacing.
struct PointPatch {
    glm::dvec3 origin; // a corner of the shortest edge
    glm::dvec3 along,
        up; // along · (p − origin): weight of the edge's other corner at p; up · (p − origin): of the opposite one
    glm::dvec3 normal; // of the side, unit length
    std::uint32_t firstRow, steps;
};

/// Which patches a surface has: triangle i those from first + sides · i on. A closed mesh has the side that is outside;
/// others have both, the one that is seen counter-clockwise first.
struct SurfacePatches {
    std::uint32_t first = 0;
    std::uint32_t sides = 0;    // 0: no such surface
    std::uint32_t mirrored = 0; // 1: the outside of a closed mesh is seen clockwise
};

struct SurfacePoints {
    std::vector<SurfacePatches> surfaces; // by surface id
    std::vector<PointPatch> patches;
    std::vector<PointRow> rows;
    std::vector<SurfacePoint> points;
    double spacing = 0; // metres: no two neighbours of a row and no two rows are farther apart
};

/// At most `budget` points on the triangles of `snapshot`, beside one on each triangle that is smaller than their spacing.
SurfacePoints spreadPoints(const Snapshot& snapshot, std::size_t budget);

} // namespace shadowbench::techniques
