#include "scene/mesh.h"

#include "base/error.h"
#include "scene/mesh_faults.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace shadowbench {
namespace {

void requireFinite(const Mesh& mesh, const std::string& what) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw BadInput(fmt::format("{}: position {} is not finite", what, i));
    }
}

void requireIndices(const Mesh& mesh, const std::string& what) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner)
            if (mesh.triangles[i][corner] >= mesh.positions.size())
                throw BadInput(fmt::format("{}: triangle {} uses position {}, but there are only {}", what, i,
                                           mesh.triangles[i][corner], mesh.positions.size()));
}

std::string placeOf(const Fault& fault) {
    return fmt::format("the first near ({:g}, {:g}, {:g})", fault.place.x, fault.place.y, fault.place.z);
}

void requireAreas(const Mesh& mesh, const std::string& what) {
    const auto found = std::ranges::find_if_not(mesh.triangles, [&](const glm::uvec3& t) { return hasArea(mesh, t); });
    if (found == mesh.triangles.end()) return;
    const Fault flat = faultsOf(mesh).flat;
    throw BadInput(fmt::format("{}: triangle {} has zero area, as {} of {} have, {}; delete them in the modelling program "
                               "(Blender: Mesh > Clean Up > Degenerate Dissolve){}",
                               what, found - mesh.triangles.begin(), flat.count, mesh.triangles.size(), placeOf(flat),
                               mesh.closed ? ", or leave out closed = true" : ""));
}

/// A mesh that is not closed fails with its gravest fault, the likely cause and what to do.
void requireClosed(const Mesh& mesh, const std::string& what) {
    const EdgeFaults faults = edgeFaultsOf(mesh);
    const auto fail = [&](const Fault& fault, const char* found, const char* remedy) {
        throw BadInput(fmt::format("{}: not closed: {} of its edges {}, {}: {}, or leave out closed = true", what,
                                   fault.count, found, placeOf(fault), remedy));
    };
    if (faults.crowded.count > 0)
        fail(faults.crowded, "belong to more than two triangles",
             "parts share an edge, or faces lie inside or upon each other; separate the parts or delete the inner faces in "
             "the modelling program");
    if (faults.turned.count > 0)
        fail(faults.turned, "belong to two triangles in the same direction",
             "some faces are turned inside out; turn them in the modelling program (Blender: Mesh > Normals > Recalculate "
             "Outside)");
    if (faults.open.count > 0)
        fail(faults.open, "have no neighbour",
             "there is a hole, or vertices that should be one lie apart; fill it or merge them in the modelling program "
             "(Blender: Merge by Distance)");
    if (!(signedVolume(mesh) > 0))
        throw BadInput(fmt::format("{}: the mesh is wound inside out; write flip = true beside its file", what));
    const std::vector<Mesh> parts = partsOf(mesh);
    if (const Fault turned = turnedPartsOf(parts); turned.count > 0)
        throw BadInput(fmt::format("{}: {} of its {} parts are turned inside out, {}; turn them in the modelling program "
                                   "(Blender: Mesh > Normals > Recalculate Outside), or leave out closed = true",
                                   what, turned.count, parts.size(), placeOf(turned)));
}

bool before(const glm::vec3& a, const glm::vec3& b) {
    if (a.x != b.x) return a.x < b.x;
    return a.y != b.y ? a.y < b.y : a.z < b.z;
}

} // namespace

void Bounds::add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
}

void Bounds::add(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
}

std::array<glm::dvec3, 8> Bounds::corners() const {
    std::array<glm::dvec3, 8> result;
    for (unsigned i = 0; i < 8; ++i) result[i] = {i & 1U ? high.x : low.x, i & 2U ? high.y : low.y, i & 4U ? high.z : low.z};
    return result;
}

Bounds Mesh::bounds() const {
    Bounds box;
    for (const glm::vec3& position : positions) box.add(glm::dvec3(position));
    return box;
}

void requireNumbers(const Mesh& mesh, const std::string& what) {
    requireFinite(mesh, what);
    requireIndices(mesh, what);
}

void requireWellFormed(const Mesh& mesh, const std::string& what) {
    if (mesh.triangles.empty()) throw BadInput(fmt::format("{}: the mesh has no triangle", what));
    requireNumbers(mesh, what);
    requireAreas(mesh, what);
    if (mesh.closed) requireClosed(mesh, what);
}

bool hasArea(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    return glm::length(glm::cross(b - a, c - a)) > 1e-12 * longest;
}

Mesh weld(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return before(mesh.positions[a], mesh.positions[b]); });
    std::vector<std::uint32_t> first(order.size()); // of each position, the first equal one
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && mesh.positions[order[i]] == mesh.positions[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }

    Mesh result{{}, {}, mesh.closed};
    std::vector<std::uint32_t> kept(order.size());
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        if (first[i] != i) continue;
        kept[i] = static_cast<std::uint32_t>(result.positions.size());
        result.positions.push_back(mesh.positions[i]);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 joined(kept[first[t.x]], kept[first[t.y]], kept[first[t.z]]);
        if (joined.x != joined.y && joined.y != joined.z && joined.z != joined.x) result.triangles.push_back(joined);
    }
    return result;
}

Bounds transformed(const Bounds& box, const glm::dmat4& world) {
    Bounds result;
    if (box.empty()) return result;
    for (const glm::dvec3& corner : box.corners()) result.add(glm::dvec3(world * glm::dvec4(corner, 1.0)));
    return result;
}

} // namespace shadowbench
