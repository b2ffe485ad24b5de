#include "techniques/environment/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace shadowbench::techniques {
namespace {

/// Corners 0 and 1 span the shortest edge.
using Triangle = std::array<glm::dvec3, 3>;

using VisitTriangle = std::function<void(const Triangle&, const Mesh&, const Placement&)>;

Triangle fromShortestEdge(Triangle t) {
    const auto length = [&](std::size_t i) { return glm::distance(t.at(i), t.at((i + 1) % 3)); };
    std::size_t shortest = 0;
    for (const std::size_t i : {1U, 2U})
        if (length(i) < length(shortest)) shortest = i;
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(shortest), t.end());
    return t;
}

void forEachTriangle(const Mesh& mesh, const Placement& placement, const VisitTriangle& visit) {
    const auto corner = [&](std::uint32_t i) {
        return glm::dvec3(placement.world * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
    };
    for (const glm::uvec3& t : mesh.triangles)
        visit(fromShortestEdge({corner(t.x), corner(t.y), corner(t.z)}), mesh, placement);
}

void forEachTriangle(const Snapshot& snapshot, const VisitTriangle& visit) {
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) forEachTriangle(*batch.mesh, placement, visit);
}

std::uint32_t sidesOf(const Mesh& mesh) { return mesh.closed ? 1 : 2; }

bool isMirrored(const Placement& placement) { return glm::determinant(glm::dmat3(placement.world)) < 0; }

/// Rows of a triangle, less one.
std::uint32_t rowSteps(const Triangle& t, double spacing) {
    const double side = std::max(glm::distance(t[0], t[2]), glm::distance(t[1], t[2]));
    return side <= spacing ? 0 : static_cast<std::uint32_t>(std::ceil(side / spacing));
}

/// Points of row `row`, less one. A row much shorter than the spacing has one point in its middle.
std::uint32_t pointSteps(const Triangle& t, double spacing, std::uint32_t row, std::uint32_t steps) {
    if (steps == 0) return 0;
    const double length = glm::distance(t[0], t[1]) * (1 - static_cast<double>(row) / steps);
    return length <= 0.5 * spacing ? 0 : static_cast<std::uint32_t>(std::ceil(length / spacing));
}

/// Points of a triangle that is not smaller than the spacing, else 0.
std::size_t pointsInRows(const Triangle& t, double spacing) {
    const std::uint32_t steps = rowSteps(t, spacing);
    if (steps == 0) return 0;
    std::size_t count = 0;
    for (std::uint32_t row = 0; row <= steps; ++row) count += pointSteps(t, spacing, row, steps) + 1;
    return count;
}

std::size_t pointsInRows(const Snapshot& snapshot, double spacing) {
    std::size_t count = 0;
    forEachTriangle(snapshot, [&](const Triangle& t, const Mesh& mesh, const Placement&) {
        count += sidesOf(mesh) * pointsInRows(t, spacing);
    });
    return count;
}

/// The least spacing that `budget` allows, to a thousandth.
double spacingFor(const Snapshot& snapshot, std::size_t budget) {
    const Bounds bounds = snapshot.bounds();
    double wide = glm::distance(bounds.low, bounds.high), narrow = 1e-5 * wide;
    while (wide > 1.001 * narrow) {
        const double middle = std::sqrt(wide * narrow);
        (pointsInRows(snapshot, middle) <= budget ? wide : narrow) = middle;
    }
    return wide;
}

PointPatch patchOf(const Triangle& t, const glm::dvec3& normal) {
    // Gradients of the barycentric weights of corners 1 and 2.
    const glm::dvec3 edge = t[1] - t[0], side = t[2] - t[0], area = glm::cross(edge, side);
    const double square = glm::dot(area, area);
    return {.origin = t[0],
            .along = glm::cross(side, area) / square,
            .up = glm::cross(area, edge) / square,
            .normal = normal,
            .firstRow = 0,
            .steps = 0};
}

/// Where row and point lie in the triangle. A little inside: what stands on a corner or an edge is neither above nor below
/// the surfaces that meet there.
glm::dvec3 pointAt(const Triangle& t, double share, double up) {
    constexpr double inwards = 1e-4;
    const glm::dvec3 centroid = (t[0] + t[1] + t[2]) / 3.0;
    return glm::mix(glm::mix(glm::mix(t[0], t[1], share), t[2], up), centroid, inwards);
}

class PointSpreader {
public:
    explicit PointSpreader(double spacing) { result_.spacing = spacing; }

    void beginSurface(const Mesh& mesh, const Placement& placement) {
        if (result_.surfaces.size() <= placement.id) result_.surfaces.resize(placement.id + 1);
        result_.surfaces[placement.id] = {static_cast<std::uint32_t>(result_.patches.size()), sidesOf(mesh),
                                          mesh.closed && isMirrored(placement) ? 1U : 0U};
    }

    void addTriangle(const Triangle& t, const Mesh& mesh, const Placement& placement) {
        const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
        const bool outsideIsBack = mesh.closed && isMirrored(placement);
        addSide(t, outsideIsBack ? -normal : normal);
        if (!mesh.closed) addSide(t, -normal);
    }

    [[nodiscard]] SurfacePoints take() { return std::move(result_); }

private:
    void addSide(const Triangle& t, const glm::dvec3& normal) {
        PointPatch patch = patchOf(t, normal);
        patch.firstRow = static_cast<std::uint32_t>(result_.rows.size());
        patch.steps = rowSteps(t, result_.spacing);
        for (std::uint32_t row = 0; row <= patch.steps; ++row)
            addRow(t, normal, patch.steps == 0 ? 1.0 / 3 : static_cast<double>(row) / patch.steps,
                   pointSteps(t, result_.spacing, row, patch.steps));
        result_.patches.push_back(patch);
    }

    void addRow(const Triangle& t, const glm::dvec3& normal, double up, std::uint32_t steps) {
        result_.rows.push_back({static_cast<std::uint32_t>(result_.points.size()), steps});
        for (std::uint32_t i = 0; i <= steps; ++i)
            result_.points.push_back({pointAt(t, steps == 0 ? 0.5 : static_cast<double>(i) / steps, up), normal});
    }

    SurfacePoints result_;
};

} // namespace

SurfacePoints spreadPoints(const Snapshot& snapshot, std::size_t budget) {
    PointSpreader spreader(spacingFor(snapshot, budget));
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) {
            spreader.beginSurface(*batch.mesh, placement);
            forEachTriangle(*batch.mesh, placement, [&](const Triangle& t, const Mesh& mesh, const Placement& of) {
                spreader.addTriangle(t, mesh, of);
            });
        }
    return spreader.take();
}

} // namespace shadowbench::techniques
