// Triangle meshes: metres, right-handed, counter-clockwise seen from outside.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace shadowbench {

/// An axis-aligned box; empty until the first point is added.
struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point);
    void add(const Bounds& other);
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    [[nodiscard]] glm::dvec3 centre() const { return 0.5 * (low + high); }
    [[nodiscard]] std::array<glm::dvec3, 8> corners() const;
};

/// How many of one kind there are, and where the first is: the middle of an edge or triangle, or a position.
struct Fault {
    std::size_t count = 0;
    glm::vec3 place{0};

    void add(const glm::vec3& where) {
        if (count++ == 0) place = where;
    }
};

struct MaskedMesh; // scene/masked_mesh.h

/// Positions are 32-bit floats so that the rasteriser and the exact ground truth start from the very same numbers.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;         // indices into positions
    bool closed = false;                       // 2-manifold without border, consistently wound, outward
    Fault flat{};                              // triangles of no area that have been left out
    std::shared_ptr<const MaskedMesh> cards{}; // of which an alpha test leaves this; none of most meshes

    [[nodiscard]] Bounds bounds() const;
};

/// Throws BadInput naming `what` unless every position is finite, every index in range, no triangle has zero area, and,
/// where the mesh says it is closed, every directed edge is matched by exactly one opposite one and the enclosed volume is
/// positive.
void requireWellFormed(const Mesh& mesh, const std::string& what);

/// Whether the corners of a triangle of `mesh` span an area. Collinear corners of 32-bit positions give at most rounding of
/// the double products: 10⁻¹² of the longest side squared.
bool hasArea(const Mesh& mesh, const glm::uvec3& triangle);

/// Joins equal positions (the first one stays; −0 equals 0) and drops the triangles that collapse.
Mesh weld(const Mesh& mesh);

/// The bounds of `box` after the affine map `world`.
Bounds transformed(const Bounds& box, const glm::dmat4& world);

} // namespace shadowbench
