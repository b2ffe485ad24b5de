#include "scene/mesh_faults.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <map>
#include <numeric>
#include <tuple>

namespace shadowbench {
namespace {

/// An edge of a triangle, without its direction but for `back`: whether it runs from `high` to `low`.
struct Edge {
    std::uint32_t low, high;
    bool back;
    friend auto operator<=>(const Edge&, const Edge&) = default;
};

Edge edgeBetween(std::uint32_t from, std::uint32_t to) { return {std::min(from, to), std::max(from, to), from > to}; }

void findTriangles(const Mesh& mesh, MeshFaults& faults) {
    const auto middle = [&](const glm::uvec3& t) {
        return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F;
    };
    faults.flat = mesh.flat;
    std::vector<std::array<std::uint32_t, 3>> corners;
    corners.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        if (!hasArea(mesh, t)) faults.flat.add(middle(t));
        corners.push_back({t.x, t.y, t.z});
        std::ranges::sort(corners.back());
    }
    std::ranges::sort(corners);
    for (std::size_t i = 1; i < corners.size(); ++i)
        if (corners[i] == corners[i - 1]) faults.repeated.add(middle({corners[i][0], corners[i][1], corners[i][2]}));
}

void findPositions(const Mesh& mesh, MeshFaults& faults) {
    std::vector<glm::vec3> positions = mesh.positions;
    std::ranges::sort(positions,
                      [](const auto& a, const auto& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    for (std::size_t i = 1; i < positions.size(); ++i)
        if (positions[i] == positions[i - 1]) faults.doubled.add(positions[i]);
}

} // namespace

EdgeFaults edgeFaultsOf(const Mesh& mesh) {
    EdgeFaults faults;
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (const Edge& edge : {edgeBetween(t.x, t.y), edgeBetween(t.y, t.z), edgeBetween(t.z, t.x)}) edges.push_back(edge);
    std::ranges::sort(edges);
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
        const Edge& edge = edges[first];
        while (last < edges.size() && edges[last].low == edge.low && edges[last].high == edge.high) ++last;
        const glm::vec3 middle = 0.5F * (mesh.positions[edge.low] + mesh.positions[edge.high]);
        if (last - first == 1) faults.open.add(middle);
        if (last - first > 2) faults.crowded.add(middle);
        if (last - first == 2 && edge.back == edges[first + 1].back) faults.turned.add(middle);
    }
    return faults;
}

MeshFaults faultsOf(const Mesh& mesh) {
    MeshFaults faults;
    faults.edges = edgeFaultsOf(mesh);
    faults.volume = signedVolume(mesh);
    findTriangles(mesh, faults);
    findPositions(mesh, faults);
    const std::vector<Mesh> parts = partsOf(mesh);
    faults.parts = parts.size();
    if (faults.edges.closed()) faults.turnedParts = turnedPartsOf(parts);
    return faults;
}

std::vector<Mesh> partsOf(const Mesh& mesh) {
    std::vector<std::uint32_t> joined(mesh.positions.size()); // towards the least position of the part
    std::iota(joined.begin(), joined.end(), 0U);
    const auto least = [&](std::uint32_t i) {
        while (joined[i] != i) i = joined[i] = joined[joined[i]];
        return i;
    };
    for (const glm::uvec3& t : mesh.triangles)
        for (const std::uint32_t other : {t.y, t.z}) {
            const std::uint32_t a = least(t.x), b = least(other);
            joined[std::max(a, b)] = std::min(a, b);
        }
    std::map<std::uint32_t, Mesh> parts;
    for (const glm::uvec3& t : mesh.triangles) parts[least(t.x)].triangles.push_back(t);
    std::vector<Mesh> result;
    for (auto& [first, part] : parts) {
        std::map<std::uint32_t, std::uint32_t> own;
        for (glm::uvec3& t : part.triangles)
            for (int corner = 0; corner < 3; ++corner) {
                const auto [place, isNew] = own.emplace(t[corner], static_cast<std::uint32_t>(own.size()));
                if (isNew) part.positions.push_back(mesh.positions[t[corner]]);
                t[corner] = place->second;
            }
        result.push_back(std::move(part));
    }
    return result;
}

/// A part that encloses less than nothing is a cavity where the others wind around it.
Fault turnedPartsOf(const std::vector<Mesh>& parts) {
    Fault turned;
    std::vector<Bounds> boxes;
    for (const Mesh& part : parts) boxes.push_back(part.bounds());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!(signedVolume(parts[i]) < 0)) continue;
        const glm::vec3& place = parts[i].positions.front();
        double around = 0;
        for (std::size_t other = 0; other < parts.size(); ++other)
            if (other != i && glm::clamp(glm::dvec3(place), boxes[other].low, boxes[other].high) == glm::dvec3(place))
                around += windingNumber(parts[other], glm::dvec3(place)); // none winds around what is beside its bounds
        if (around < 0.5) turned.add(place);
    }
    return turned;
}

/// By the divergence theorem.
double signedVolume(const Mesh& mesh) {
    double sixfold = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        sixfold += glm::dot(a, glm::cross(b, c));
    }
    return sixfold / 6;
}

/// By the solid angles of the triangles (van Oosterom and Strackee 1983), whose sum is 4π within.
double windingNumber(const Mesh& mesh, const glm::dvec3& point) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - point, b = glm::dvec3(mesh.positions[t.y]) - point,
                         c = glm::dvec3(mesh.positions[t.z]) - point;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / glm::two_pi<double>();
}

} // namespace shadowbench
