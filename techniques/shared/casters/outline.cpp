#include "techniques/shared/casters/outline.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace shadowbench::techniques {

std::vector<OutlineEdge> outline(const EdgeMesh& mesh, const std::vector<bool>& facing) {
    std::vector<OutlineEdge> edges;
    for (const EdgeMesh::Edge& edge : mesh.edges())
        if (edge.right == EdgeMesh::none || facing[edge.left] != facing[edge.right])
            edges.push_back({edge.from, edge.to, !facing[edge.left]});
    return edges;
}

glm::dmat4 lightFromWorld(const Light& light, const glm::dvec3& axis) {
    const glm::dvec3 right = glm::normalize(light.u);
    const glm::dvec3 up = glm::cross(right, axis);
    const auto row = [&](const glm::dvec3& direction) { return glm::dvec4(direction, -glm::dot(direction, light.centre)); };
    return glm::transpose(glm::dmat4(row(right), row(up), row(axis), glm::dvec4(0, 0, 0, 1)));
}

namespace {

/// Moves the end of a segment that lies nearer than `nearest` along it to that distance.
void cut(OutlinePoint& end, const OutlinePoint& other, double nearest) {
    if (end.seen.z >= nearest) return;
    const double share = (nearest - end.seen.z) / (other.seen.z - end.seen.z);
    end = {glm::mix(end.object, other.object, share), glm::mix(end.seen, other.seen, share)};
}

std::optional<OutlineSegment> segment(const OutlinePoint& a, const OutlinePoint& b, double nearest) {
    if (a.seen.z < nearest && b.seen.z < nearest) return std::nullopt;
    OutlineSegment result{a, b, EdgeMesh::none, EdgeMesh::none, {}};
    cut(result.from, b, nearest);
    cut(result.to, a, nearest);
    const glm::dvec2 along = result.to.image() - result.from.image();
    constexpr double shortest = 1e-9; // in the light's image: a millionth of the texel of any map
    if (glm::length(along) < shortest) return std::nullopt;
    result.outward = glm::normalize(glm::dvec2(along.y, -along.x));
    return result;
}

double signedAngle(const glm::dvec2& a, const glm::dvec2& b) { return std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)); }

/// Indices of segments by the vertex where they begin.
using Beginnings = std::unordered_multimap<std::uint32_t, std::size_t>;

/// By how much the outline turns where `segment` ends; nothing where no other begins there.
std::optional<double> turnAfter(const OutlineSegment& segment, const std::vector<OutlineSegment>& all,
                                const Beginnings& beginnings) {
    if (segment.last == EdgeMesh::none) return std::nullopt;
    std::optional<double> least;
    const auto [first, last] = beginnings.equal_range(segment.last);
    for (auto next = first; next != last; ++next) {
        const double turn = signedAngle(segment.outward, all[next->second].outward);
        if (!least || std::abs(turn) < std::abs(*least)) least = turn;
    }
    return least;
}

} // namespace

std::vector<OutlineCorner> SeenOutline::corners() const {
    Beginnings beginnings;
    for (std::size_t i = 0; i < segments.size(); ++i) beginnings.emplace(segments[i].first, i);
    std::vector<OutlineCorner> result;
    for (const OutlineSegment& segment : segments)
        if (const auto turn = turnAfter(segment, segments, beginnings); turn && *turn > 0)
            result.push_back({segment.to, segment.outward, *turn});
    return result;
}

SeenOutline seenOutline(const EdgeMesh& mesh, const glm::dmat4& lightFromObject, double nearest) {
    const auto point = [&](std::uint32_t vertex) {
        const glm::dvec3 object(mesh.mesh().positions[vertex]);
        return OutlinePoint{object, glm::dvec3(lightFromObject * glm::dvec4(object, 1))};
    };
    SeenOutline result;
    std::unordered_set<std::uint32_t> met;
    const glm::dvec4 light = glm::inverse(lightFromObject) * glm::dvec4(0, 0, 0, 1);
    for (const OutlineEdge& edge : outline(mesh, mesh.facing(light))) {
        const std::uint32_t first = edge.casterOnRight ? edge.to : edge.from;
        const std::uint32_t last = edge.casterOnRight ? edge.from : edge.to;
        const OutlinePoint a = point(first), b = point(last);
        auto seen = segment(a, b, nearest);
        if (!seen) continue;
        if (a.seen.z >= nearest) seen->first = first;
        if (b.seen.z >= nearest) seen->last = last;
        result.segments.push_back(*seen);
        if (seen->first != EdgeMesh::none && met.insert(first).second) result.vertices.push_back(a);
        if (seen->last != EdgeMesh::none && met.insert(last).second) result.vertices.push_back(b);
    }
    return result;
}

} // namespace shadowbench::techniques
